import type { Point } from '../base/geometry';

/** A line that shows what something snapped to, stage metres. */
export interface Guide {
  axis: 'x' | 'y';
  at: number;
}

/** The drag after snapping, stage metres, and the lines that it snapped to. */
export interface Snapped {
  dx: number;
  dy: number;
  guides: Guide[];
}

export interface SnapOptions {
  /** Grid step, metres; 0: none. */
  grid_m: number;
  /** Largest distance that snaps, metres. */
  reach_m: number;
  /** Positions that the dragged position aligns with, stage metres. */
  neighbours: readonly Point[];
}

/** Snaps a drag of `lead` by (dx, dy), metres, each axis on its own: to a neighbour's coordinate, else to the grid. */
export function snap(lead: Point, dx: number, dy: number, options: SnapOptions): Snapped {
  const x = snapAxis(lead.x + dx, 'x', options);
  const y = snapAxis(lead.y + dy, 'y', options);
  const guides: Guide[] = [];
  if (x.guide !== null) guides.push({ axis: 'x', at: x.guide });
  if (y.guide !== null) guides.push({ axis: 'y', at: y.guide });
  return { dx: x.value - lead.x, dy: y.value - lead.y, guides };
}

function snapAxis(value: number, axis: 'x' | 'y', options: SnapOptions) {
  let [best, distance] = [null as number | null, options.reach_m];
  for (const neighbour of options.neighbours) {
    const d = Math.abs(neighbour[axis] - value);
    if (d < distance) [best, distance] = [neighbour[axis], d];
  }
  if (best !== null) return { value: best, guide: best };
  const { grid_m } = options;
  if (grid_m <= 0) return { value, guide: null };
  const onGrid = Math.round(value / grid_m) * grid_m;
  return { value: Math.abs(onGrid - value) <= options.reach_m ? onGrid : value, guide: null };
}
