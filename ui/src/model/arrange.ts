import { type Box, type Point, along, boxOf, centreOf } from '../base/geometry';

/** Arrangements map positions in the order of the pixels' ids to as many new positions. */
export type Places = readonly Point[];

export type Edge = 'left' | 'centre' | 'right' | 'top' | 'middle' | 'bottom';

export function align(places: Places, edge: Edge): Point[] {
  const box = boxOf(places);
  const { x, y } = centreOf(box);
  const to = {
    left: box.minX,
    centre: x,
    right: box.maxX,
    top: box.maxY,
    middle: y,
    bottom: box.minY,
  }[edge];
  const horizontal = edge === 'left' || edge === 'centre' || edge === 'right';
  return places.map((p) => (horizontal ? { x: to, y: p.y } : { x: p.x, y: to }));
}

/** Equal gaps along an axis between the outermost two. */
export function distribute(places: Places, axis: 'x' | 'y'): Point[] {
  const order = places.map((_, i) => i).sort((a, b) => at(places, a)[axis] - at(places, b)[axis]);
  const [first, last] = [order[0] ?? 0, order[order.length - 1] ?? 0];
  const [from, to] = [places[first]?.[axis] ?? 0, places[last]?.[axis] ?? 0];
  const result = places.map((p) => ({ ...p }));
  order.forEach((index, rank) => {
    const place = result[index];
    if (place) place[axis] = from + ((to - from) * rank) / Math.max(1, order.length - 1);
  });
  return result;
}

const at = (places: Places, i: number): Point => places[i] ?? { x: 0, y: 0 };

/** A straight line between the two pixels that are farthest apart along the longer side. */
export function line(places: Places): Point[] {
  const box = boxOf(places);
  const axis = box.maxX - box.minX >= box.maxY - box.minY ? 'x' : 'y';
  const order = sorted(places, axis);
  const ends = [at(places, order[0] ?? 0), at(places, order[order.length - 1] ?? 0)];
  return give(places, order, along(ends, places.length, false));
}

const sorted = (places: Places, axis: 'x' | 'y') =>
  places.map((_, i) => i).sort((a, b) => at(places, a)[axis] - at(places, b)[axis]);

/** Gives the n-th of `order` the n-th of `targets`. */
function give(places: Places, order: readonly number[], targets: readonly Point[]): Point[] {
  const result = places.map((p) => ({ ...p }));
  order.forEach((index, rank) => (result[index] = { ...(targets[rank] ?? at(places, index)) }));
  return result;
}

/** Order by angle about the centre, so that paths to a closed shape cross little. */
function around(places: Places): number[] {
  const c = centreOf(boxOf(places));
  const angle = (i: number) => Math.atan2(at(places, i).x - c.x, at(places, i).y - c.y);
  return places.map((_, i) => i).sort((a, b) => angle(a) - angle(b));
}

export type Shape = 'circle' | 'heart' | 'star' | 'square';

/** Corners or samples of a closed shape in a box of −1..1, clockwise from the top. */
function outline(shape: Shape): Point[] {
  const turns = (n: number, f: (a: number, i: number) => Point) =>
    Array.from({ length: n }, (_, i) => f((2 * Math.PI * i) / n, i));
  switch (shape) {
    case 'circle':
      return turns(360, (a) => ({ x: Math.sin(a), y: Math.cos(a) }));
    case 'heart':
      return turns(360, (a) => ({
        x: Math.sin(a) ** 3,
        y:
          (13 * Math.cos(a) - 5 * Math.cos(2 * a) - 2 * Math.cos(3 * a) - Math.cos(4 * a) + 2.5) /
          14.5,
      }));
    case 'star':
      return turns(10, (a, i) => {
        const r = i % 2 === 0 ? 1 : 0.42;
        return { x: r * Math.sin(a), y: r * Math.cos(a) };
      });
    case 'square':
      return [
        { x: -1, y: 1 },
        { x: 1, y: 1 },
        { x: 1, y: -1 },
        { x: -1, y: -1 },
      ];
  }
}

/** Positions along the outline of a shape in a box, at least `gap_m` apart: the shape may outgrow the box. */
export function shape(places: Places, kind: Shape, box: Box, gap_m: number): Point[] {
  const c = centreOf(box);
  let r = Math.max(Math.min(box.maxX - box.minX, box.maxY - box.minY) / 2, 0.01);
  const unit = outline(kind);
  const points = along(unit, places.length, true);
  const least = leastGap(points);
  if (places.length > 1 && least * r < gap_m) r = gap_m / least;
  return give(
    places,
    around(places),
    points.map((p) => ({ x: c.x + p.x * r, y: c.y + p.y * r })),
  );
}

function leastGap(points: readonly Point[]): number {
  let least = Infinity;
  points.forEach((a, i) => {
    for (const b of points.slice(i + 1)) least = Math.min(least, Math.hypot(a.x - b.x, a.y - b.y));
  });
  return Math.max(least, 1e-6);
}

/** Rows and columns that fill the box, at least `gap_m` apart. */
export function grid(places: Places, gap_m: number): Point[] {
  const box = boxOf(places);
  const [w, h] = [Math.max(box.maxX - box.minX, gap_m), Math.max(box.maxY - box.minY, gap_m)];
  const columns = Math.max(
    1,
    Math.min(places.length, Math.round(Math.sqrt((places.length * w) / h))),
  );
  const rows = Math.ceil(places.length / columns);
  const stepX = Math.max(gap_m, columns > 1 ? w / (columns - 1) : 0);
  const stepY = Math.max(gap_m, rows > 1 ? h / (rows - 1) : 0);
  const c = centreOf(box);
  const byRow = places.map((_, i) => i).sort((a, b) => at(places, b).y - at(places, a).y);
  const order: number[] = [];
  for (let r = 0; r < rows; r++)
    order.push(
      ...byRow
        .slice(r * columns, (r + 1) * columns)
        .sort((a, b) => at(places, a).x - at(places, b).x),
    );
  const targets = order.map((_, k) => ({
    x: c.x + ((k % columns) - (columns - 1) / 2) * stepX,
    y: c.y - (Math.floor(k / columns) - (rows - 1) / 2) * stepY,
  }));
  return give(places, order, targets);
}

export function mirror(places: Places, axis: 'x' | 'y'): Point[] {
  const c = centreOf(boxOf(places));
  return places.map((p) =>
    axis === 'x' ? { x: 2 * c.x - p.x, y: p.y } : { x: p.x, y: 2 * c.y - p.y },
  );
}

/** Rounds of pushing; pixels that are still too close then have no room. */
const ROUNDS_MAX = 200;

/** Pushes pixels closer than `gap_m` apart by the least distance. */
export function spread(places: Places, gap_m: number): Point[] {
  const result = places.map((p) => ({ ...p }));
  for (let round = 0; round < ROUNDS_MAX; round++) if (!push(result, gap_m, round)) break;
  return result;
}

function push(points: Point[], gap_m: number, round: number): boolean {
  let moved = false;
  for (let i = 0; i < points.length; i++)
    for (let j = i + 1; j < points.length; j++) {
      const [a, b] = [points[i] as Point, points[j] as Point];
      const [dx, dy] = [b.x - a.x, b.y - a.y];
      const d = Math.hypot(dx, dy);
      if (d >= gap_m - 1e-6) continue;
      moved = true;
      // Pixels at the same position part along a direction that depends on their index.
      const angle = (i * 2.4 + j + round) % (2 * Math.PI);
      const [ux, uy] = d > 1e-9 ? [dx / d, dy / d] : [Math.cos(angle), Math.sin(angle)];
      const half = (gap_m - d) / 2 + 1e-7;
      a.x -= ux * half;
      a.y -= uy * half;
      b.x += ux * half;
      b.y += uy * half;
    }
  return moved;
}

/** Assigns pixels to targets from left to right, so that no pixel jumps farther than needed. */
export function nearest(places: Places, targets: readonly Point[]): Point[] {
  const byX = [...targets].sort((a, b) => a.x - b.x || a.y - b.y);
  return give(places, sorted(places, 'x'), byX);
}
