import { type Point, boxOf, centreOf } from '../base/geometry';

/** Positions in stage metres. Each arrangement returns a new position for each given one, in the same order. */
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

/** Gives equal steps along an axis between the two outermost positions, which stay. The other axis stays. */
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

export function mirror(places: Places, axis: 'x' | 'y'): Point[] {
  const c = centreOf(boxOf(places));
  return places.map((p) =>
    axis === 'x' ? { x: 2 * c.x - p.x, y: p.y } : { x: p.x, y: 2 * c.y - p.y },
  );
}

/** Most rounds of pushing. Pixels that are still too close after the last round stay so. */
const ROUNDS_MAX = 200;

/** Pushes pixels closer than `gap_m` metres apart, both by half of what is missing, for up to `ROUNDS_MAX` rounds. */
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
      // Pixels at the same position are pushed along a direction that depends on their indices and the round.
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
