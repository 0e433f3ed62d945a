import type { Point } from '../base/geometry';

/** An open menu of the stage. */
export interface MenuAt {
  /** The menu's corner on the canvas, CSS pixels. */
  at: Point;
  /** What the menu is about; a number: index of a no-go area. */
  about: 'pixels' | 'floor' | number;
}
