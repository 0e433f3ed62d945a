import type { Dot, Obstacle, Point, Polyline } from '../base/geometry';
import type { Unit } from '../base/units';
import type { Stage } from '../model/show';
import type { Camera } from './camera';

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
  /** Planned paths. */
  paths: readonly Polyline[];
  /** Drawn last, in CSS pixels. */
  overlay?: (context: CanvasRenderingContext2D, camera: Camera) => void;
}

/** The empty floor of a show's stage, with a grid and rulers in `unit`. */
export const floorOf = (stage: Stage, unit: Unit) => ({
  width_m: stage.width_m,
  depth_m: stage.depth_m,
  radius_m: stage.radius_m,
  obstacles: stage.obstacles,
  grid: true,
  unit,
});
