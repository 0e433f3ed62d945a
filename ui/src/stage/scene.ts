import type { Dot, Obstacle, Point, Polyline } from '../base/geometry';
import type { Unit } from '../base/units';
import type { Stage } from '../model/show';
import type { Camera } from './camera';

/** Input of a renderer: what to draw, stage metres. */
export interface Scene {
  width_m: number;
  depth_m: number;
  radius_m: number;
  obstacles: readonly Obstacle[];
  grid: boolean;
  /** Unit of the rulers; metres by default. */
  unit?: Unit;
  /** Filled dots: where robots are, or where pixels are edited. */
  filled: readonly Dot[];
  /** Hollow dots: targets. */
  hollow: readonly Dot[];
  /** Position errors: pairs of measured and planned position. */
  errors: readonly [Point, Point][];
  /** Planned paths. */
  paths: readonly Polyline[];
  /** Draws on top of all else, in CSS pixels. */
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
