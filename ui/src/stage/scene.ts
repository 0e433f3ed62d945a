import type { Rgb } from '../base/colour';
import type { Unit } from '../base/units';
import type { Camera, Point } from './camera';

/** A disc on the floor, stage metres. */
export interface Dot {
  x: number;
  y: number;
  color: Rgb;
  /** 1 is there, less is stale or a ghost. */
  alpha: number;
}

/** Something on the floor that robots must not touch, stage metres. */
export type Obstacle =
  | { kind: 'disc'; x: number; y: number; radius_m: number }
  | { kind: 'rect'; minX: number; minY: number; maxX: number; maxY: number };

/** Everything a renderer draws. Measured places are filled, planned ones hollow; neither is drawn as the other. */
export interface Scene {
  width_m: number;
  depth_m: number;
  radius_m: number;
  obstacles: readonly Obstacle[];
  grid: boolean;
  /** Unit of the rulers; metres if nothing is said. */
  unit?: Unit;
  /** Filled: where lights are. */
  filled: readonly Dot[];
  /** Hollow: where they are meant to be. */
  hollow: readonly Dot[];
  /** From measured to planned: the error. Pairs of ends. */
  errors: readonly [Point, Point][];
  /** Planned ways, each a line of points. */
  paths: readonly { points: readonly Point[]; color: Rgb }[];
  /** Drawn last, in CSS pixels. */
  overlay?: (context: CanvasRenderingContext2D, camera: Camera) => void;
}
