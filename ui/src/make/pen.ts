import type { Point } from '../base/geometry';
import { drawnKind, lineThrough, pointsOnStage, type DrawnKind, type PenFloor } from './drawnLine';
import type { Making } from './making';
import { sizeOf } from './pictures';

/** The drawn line of the Make panel, as the pen sees it. */
export interface PenLine {
  kind: DrawnKind;
  /** Stage metres. */
  points: Point[];
  closed: boolean;
  isDrawing: boolean;
  chosen: number | null;
}

export function penLine({
  draft,
  made,
  pen,
}: Pick<Making, 'draft' | 'made' | 'pen'>): PenLine | null {
  const now = draft.get();
  const kind = drawnKind(now);
  if (kind === null) return null;
  const points = pointsOnStage(now, sizeOf(made.get().shown));
  const { isAdding, point } = pen.get();
  const chosen = point !== null && point < points.length ? point : null;
  return { kind, points, closed: now.closed, isDrawing: isAdding || points.length < 2, chosen };
}

/** Makes the line go through these points, stage metres, kept on the floor. */
export const setPoints = (making: Making, points: readonly Point[], floor: PenFloor) =>
  making.change(lineThrough(points, floor));

export const choosePoint = (making: Making, point: number | null) =>
  making.pen.update((pen) => ({ ...pen, point }));

/** Ends the adding of points; answers whether points were being added. */
export function stopAdding(making: Making): boolean {
  const { isAdding } = making.pen.get();
  making.pen.update((pen) => ({ ...pen, isAdding: false }));
  return isAdding;
}

/** Chooses the point after (1) or before (-1) the chosen one; past the end it begins again. */
export function chooseNextPoint(making: Making, by: 1 | -1) {
  const line = penLine(making);
  if (!line || line.points.length === 0) return;
  const count = line.points.length;
  const from = line.chosen ?? (by > 0 ? -1 : 0);
  choosePoint(making, (from + by + count) % count);
}
