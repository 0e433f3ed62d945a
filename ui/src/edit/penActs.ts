import { boxOf, centreOf, type Point } from '../base/geometry';
import { drawnKind, insertPoint, removePoint, withPoint, type PenFloor } from '../make/drawnLine';
import type { Making } from '../make/making';
import { choosePoint, penLine, setPoints } from '../make/pen';
import type { Editing } from './editing';
import { openMaking } from './makes';
import { nudgePicture } from './pictureHand';

export function penFloor({ editor }: Editing): PenFloor {
  const { width_m, depth_m, radius_m } = editor.state.get().show.stage;
  return { width_m, depth_m, radius_m };
}

/** How far from the last point a further one is added by keyboard, metres. */
const NEXT_M = 0.2;

/**
 * Adds a point after the chosen one, or without one after the last, and chooses it. It is halfway to the next point.
 * After the end of an open line it is `NEXT_M` to the right. A first point is `NEXT_M` left of the floor's middle.
 */
export function addPoint(editing: Editing, making: Making) {
  const line = penLine(making);
  if (!line) return;
  const { points, closed } = line;
  const index = (line.chosen ?? points.length - 1) + 1;
  const [a, b] = [points[index - 1], points[closed ? index % points.length : index]];
  const at: Point = !a
    ? { x: -NEXT_M, y: 0 }
    : b
      ? centreOf(boxOf([a, b]))
      : { x: a.x + NEXT_M, y: a.y };
  setPoints(making, insertPoint(points, index, at), penFloor(editing));
  choosePoint(making, index);
}

/** Removes the chosen point, unless the line has fewer than three, and chooses the next one. */
export function removeChosenPoint(editing: Editing, making: Making) {
  const line = penLine(making);
  if (!line || line.chosen === null || line.points.length < 3) return;
  setPoints(making, removePoint(line.points, line.chosen), penFloor(editing));
  choosePoint(making, Math.min(line.chosen, line.points.length - 2));
}

/** Moves the chosen point of a line, or without one the whole picture that is made, by `by`, metres. */
export function nudgeMaking(editing: Editing, making: Making, by: Point) {
  const line = penLine(making);
  const point = line && line.chosen !== null ? line.points[line.chosen] : undefined;
  if (!line || line.chosen === null || !point) {
    nudgePicture(making, by, editing.editor.state.get().show.stage);
    return;
  }
  const moved = { x: point.x + by.x, y: point.y + by.y };
  setPoints(making, withPoint(line.points, line.chosen, moved), penFloor(editing));
}

/**
 * Lets the user draw a line on the floor, in the open Make panel or a new one. The line is freehand, unless the panel
 * or the frame's source has a drawn line already.
 */
export function openDrawing(editing: Editing) {
  const making = editing.making.get();
  if (!making) openMaking(editing, 'shape', { shape: 'freehand' }, (d) => drawnKind(d) !== null);
  else if (drawnKind(making.draft.get()) === null)
    making.change({ tab: 'shape', shape: 'freehand', shapeNumbers: {} });
}
