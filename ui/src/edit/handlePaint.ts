import type { Point } from '../base/geometry';
import { FLOOR } from '../stage/palette';

/** Radius of a handle, CSS pixels. */
export const DOT_PX = 6;

/** Sets how handles and the lines between them are drawn. */
export function beginHandles(c: CanvasRenderingContext2D) {
  c.strokeStyle = FLOOR.chosen;
  c.fillStyle = FLOOR.plate;
  c.lineWidth = 1.5;
}

/** Draws a dashed line through places on the canvas, CSS pixels. */
export function dashedLine(c: CanvasRenderingContext2D, places: readonly Point[]) {
  c.setLineDash([5, 4]);
  c.beginPath();
  places.forEach(({ x, y }, i) => (i === 0 ? c.moveTo(x, y) : c.lineTo(x, y)));
  c.stroke();
  c.setLineDash([]);
}

/** Draws a round handle at a place on the canvas, CSS pixels. */
export function roundHandle(c: CanvasRenderingContext2D, { x, y }: Point) {
  c.beginPath();
  c.arc(x, y, DOT_PX, 0, 2 * Math.PI);
  c.fill();
  c.stroke();
}
