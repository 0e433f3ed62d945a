import { type Point, boxOf, centreOf, rotate } from '../base/geometry';

/** Shapes that are drawn on the floor. A draft keeps their points in units of their own, scaled to `size_m`. */
export const DRAWN = ['line', 'polyline', 'curve', 'freehand'] as const;
export type DrawnKind = (typeof DRAWN)[number];

export const drawnKind = ({ tab, shape }: { tab: string; shape: string }): DrawnKind | null =>
  tab === 'shape' ? (DRAWN.find((kind) => kind === shape) ?? null) : null;

/** Most points of a drawn line. */
export const POINTS_MAX = 200;

/** Least distance between two points that the pen sets, and within which a press takes a point, metres. */
export const APART_M = 0.01;

/** Room between a drawn point and the edge of the floor besides the robot's radius, metres, as the module keeps it. */
const EDGE_M = 0.021;

export interface PenFloor {
  width_m: number;
  depth_m: number;
  radius_m: number;
}

/** A line as a draft has it: its points, and where its picture lies. */
interface Line {
  points: readonly Point[];
  center: Point | null;
  size_m: number | null;
  turn: number;
}

/** The points of a line on the stage, metres. `made_m`: longer side of the made picture, used if the line has none. */
export function pointsOnStage(line: Line, made_m: number | null): Point[] {
  const box = boxOf(line.points);
  const side = Math.max(box.maxX - box.minX, box.maxY - box.minY);
  const size_m = line.size_m ?? made_m ?? side;
  const k = side > 0 ? size_m / side : 1;
  const [middle, center] = [centreOf(box), line.center ?? { x: 0, y: 0 }];
  return line.points.map((p) =>
    rotate(
      { x: center.x + (p.x - middle.x) * k, y: center.y + (p.y - middle.y) * k },
      center,
      line.turn,
    ),
  );
}

/** The line through points on the stage, metres, each moved onto the floor if it is outside or too near the edge. */
export function lineThrough(points: readonly Point[], floor: PenFloor): Line {
  const kept = points.map((p) => onFloor(p, floor));
  const box = boxOf(kept);
  const side = Math.max(box.maxX - box.minX, box.maxY - box.minY);
  return { points: kept, center: centreOf(box), size_m: side > 0 ? tidy(side) : null, turn: 0 };
}

function onFloor(p: Point, { width_m, depth_m, radius_m }: PenFloor): Point {
  const within = (value: number, side: number) => {
    const most = Math.max(0, side / 2 - radius_m - EDGE_M);
    return tidy(Math.max(-most, Math.min(most, value)));
  };
  return { x: within(p.x, width_m), y: within(p.y, depth_m) };
}

/** Metres rounded to a tenth of a millimetre. */
const tidy = (metres: number) => Math.round(metres * 1e4) / 1e4 + 0;

export const withPoint = (points: readonly Point[], index: number, at: Point): Point[] =>
  points.map((p, i) => (i === index ? at : p));

/** The points with one more at `index`; unchanged if there are `POINTS_MAX`. */
export const insertPoint = (points: readonly Point[], index: number, at: Point): Point[] =>
  points.length >= POINTS_MAX
    ? [...points]
    : [...points.slice(0, index), at, ...points.slice(index)];

export const removePoint = (points: readonly Point[], index: number): Point[] =>
  points.filter((_, i) => i !== index);

/** The middle of each piece between neighbouring points, where a point can be added; `index`: the new point's. */
export function middles(points: readonly Point[], closed: boolean): { index: number; at: Point }[] {
  const count = points.length;
  const pieces = count < 2 ? 0 : closed && count > 2 ? count : count - 1;
  return Array.from({ length: pieces }, (_, i) => {
    const [a, b] = [points[i] as Point, points[(i + 1) % count] as Point];
    return { index: i + 1, at: { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 } };
  });
}

/** How much a hand trembles, metres: smaller bends of a stroke are smoothed away. */
const TREMBLE_M = 0.008;

/**
 * The points of a stroke with which a line stays within `tolerance_m` metres of it (Ramer 1972, Douglas and Peucker
 * 1973). The tolerance doubles until there are at most `POINTS_MAX`.
 */
export function simplified(stroke: readonly Point[], tolerance_m = TREMBLE_M): Point[] {
  const kept = new Set([0, stroke.length - 1]);
  const open: [number, number][] = [[0, stroke.length - 1]];
  for (let piece = open.pop(); piece; piece = open.pop()) {
    const far = farthest(stroke, piece);
    if (far.distance_m <= tolerance_m) continue;
    kept.add(far.index);
    open.push([piece[0], far.index], [far.index, piece[1]]);
  }
  const points = stroke.filter((_, i) => kept.has(i));
  return points.length > POINTS_MAX ? simplified(stroke, tolerance_m * 2) : points;
}

/** The point between two points of a stroke that is farthest from the straight piece between these two. */
function farthest(stroke: readonly Point[], [from, to]: [number, number]) {
  const [a, b] = [stroke[from] as Point, stroke[to] as Point];
  let [index, distance_m] = [from, 0];
  for (let i = from + 1; i < to; i++) {
    const d = distanceTo(stroke[i] as Point, a, b);
    if (d > distance_m) [index, distance_m] = [i, d];
  }
  return { index, distance_m };
}

function distanceTo(p: Point, a: Point, b: Point): number {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const length = dx * dx + dy * dy;
  const along = length > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length : 0;
  const t = Math.max(0, Math.min(1, along));
  return Math.hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}
