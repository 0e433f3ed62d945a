import type { Point } from '../base/geometry';

/** An open menu of the stage. */
export interface MenuAt {
  /** Its corner on the canvas, CSS pixels. */
  at: Point;
  /** What it is about; a number: this no-go area. */
  about: 'pixels' | 'floor' | number;
}
