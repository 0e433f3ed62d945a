import { canvasFromStage, type Camera } from '../stage/camera';
import { FLOOR } from '../stage/palette';
import { middles } from '../make/drawnLine';
import type { PenLine } from '../make/pen';

/**
 * Draws the points of a drawn line and dashes straight from one to the next. When no points are being added, small dots
 * mark where one can be inserted.
 */
export function paintPen(c: CanvasRenderingContext2D, camera: Camera, line: PenLine) {
  const places = line.points.map((p) => canvasFromStage(camera, p));
  c.strokeStyle = FLOOR.guide;
  c.lineWidth = 1;
  c.setLineDash([4, 4]);
  c.beginPath();
  for (const at of places) c.lineTo(at.x, at.y);
  if (line.closed) c.closePath();
  c.stroke();
  c.setLineDash([]);
  if (!line.isDrawing && line.kind !== 'line')
    for (const { at } of middles(line.points, line.closed))
      dot(c, canvasFromStage(camera, at), 2.5, FLOOR.guide);
  places.forEach((at, i) => dot(c, at, 5, i === line.chosen ? FLOOR.chosen : FLOOR.plate));
}

function dot(
  c: CanvasRenderingContext2D,
  at: { x: number; y: number },
  radius: number,
  fill: string,
) {
  c.beginPath();
  c.arc(at.x, at.y, radius, 0, 2 * Math.PI);
  c.fillStyle = fill;
  c.fill();
  c.strokeStyle = FLOOR.guide;
  c.lineWidth = 1.5;
  c.stroke();
}
