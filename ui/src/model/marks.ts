import type { Pixel, Stage } from './show';
import { tooClose_m } from './show';

/** What is wrong with places, by pixel id. */
export interface Marks {
  tooClose: ReadonlySet<number>;
  offFloor: ReadonlySet<number>;
}

/** Which pixels are too close to another, or not wholly on the floor and clear of obstacles. */
export function marksOf(pixels: readonly Pixel[], stage: Stage): Marks {
  const offFloor = new Set(pixels.filter((p) => !onFloor(p, stage)).map((p) => p.id));
  return { tooClose: crowded(pixels, tooClose_m(stage)), offFloor };
}

export function onFloor(p: { x: number; y: number }, stage: Stage): boolean {
  const r = stage.radius_m;
  // A robot may be put exactly at the edge by a grid of tenths of a millimetre.
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

/** Sorted along x, so that only neighbours are compared. */
function crowded(pixels: readonly Pixel[], gap_m: number): Set<number> {
  const close = new Set<number>();
  const order = [...pixels].sort((a, b) => a.x - b.x);
  for (let i = 0; i < order.length; i++)
    for (let j = i + 1; j < order.length; j++) {
      const [a, b] = [order[i] as Pixel, order[j] as Pixel];
      if (b.x - a.x >= gap_m) break;
      if (Math.hypot(b.x - a.x, b.y - a.y) < gap_m - 1e-9) close.add(a.id).add(b.id);
    }
  return close;
}
