import type { Pixel, Stage } from './show';
import { tooClose_m } from './show';

/** Ids of pixels at invalid positions. */
export interface Marks {
  tooClose: ReadonlySet<number>;
  offFloor: ReadonlySet<number>;
}

/** Ids of pixels too close to another pixel, and of those at which a robot would leave the floor or hit an obstacle. */
export function marksOf(pixels: readonly Pixel[], stage: Stage): Marks {
  const offFloor = new Set(pixels.filter((p) => !onFloor(p, stage)).map((p) => p.id));
  return { tooClose: crowded(pixels, tooClose_m(stage)), offFloor };
}

function onFloor(p: { x: number; y: number }, stage: Stage): boolean {
  const r = stage.radius_m;
  // Rounding to tenths of a millimetre may put a robot exactly at the edge. Metres.
  const slack = 1e-6;
  if (
    Math.abs(p.x) > stage.width_m / 2 - r + slack ||
    Math.abs(p.y) > stage.depth_m / 2 - r + slack
  )
    return false;
  return stage.obstacles.every((o) => {
    if (o.kind === 'disc') return Math.hypot(p.x - o.x, p.y - o.y) >= o.radius_m + r;
    const dx = Math.max(o.minX - p.x, 0, p.x - o.maxX);
    const dy = Math.max(o.minY - p.y, 0, p.y - o.maxY);
    return Math.hypot(dx, dy) >= r;
  });
}

/** Ids of pixels with a neighbour closer than `gap_m` metres. A grid of such squares keeps thousands of pixels fast. */
export function crowded(
  pixels: readonly Pick<Pixel, 'id' | 'x' | 'y'>[],
  gap_m: number,
): Set<number> {
  const close = new Set<number>();
  const first = new Map<number, number>();
  const next = new Int32Array(pixels.length);
  pixels.forEach((p, i) => {
    const [cx, cy] = [Math.floor(p.x / gap_m), Math.floor(p.y / gap_m)];
    for (let x = cx - 1; x <= cx + 1; x++)
      for (let y = cy - 1; y <= cy + 1; y++)
        for (let j = first.get(cellKey(x, y)) ?? -1; j >= 0; j = next[j] ?? -1) {
          const q = pixels[j];
          if (q && Math.hypot(q.x - p.x, q.y - p.y) < gap_m - 1e-9) close.add(q.id).add(p.id);
        }
    const here = cellKey(cx, cy);
    next[i] = first.get(here) ?? -1;
    first.set(here, i);
  });
  return close;
}

/** One number for a square of the grid; unique for -32768 to 32767 squares along each axis. */
const cellKey = (x: number, y: number) => (x + 0x8000) * 0x10000 + (y + 0x8000);
