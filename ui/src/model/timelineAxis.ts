/** The timeline from left to right: which moment of show time is where on the screen. */
export interface Axis {
  /** Moments at its ends, seconds. */
  from_s: number;
  to_s: number;
  /** CSS pixels a second. */
  scale: number;
}

/** Smallest and largest zoom, CSS pixels a second. */
const [SCALE_MIN, SCALE_MAX] = [0.2, 400];

export const xOf = (axis: Axis, at_s: number) => (at_s - axis.from_s) * axis.scale;
export const momentAt = (axis: Axis, x: number) => axis.from_s + x / axis.scale;

export const withinScales = (scale: number) => Math.max(SCALE_MIN, Math.min(SCALE_MAX, scale));

/** The zoom at which `lasts_s` seconds, but at least 1, fill `width_px`, within the zoom's limits. */
export const fittingScale = (lasts_s: number, width_px: number) =>
  withinScales(width_px / Math.max(1, lasts_s));

/** Distances of ticks to choose from, seconds. */
const STEPS_S = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600];
/** Least distance of ticks with a text, CSS pixels. */
const TICK_PX = 64;

/** Distance of the ticks at a zoom in CSS pixels a second, seconds. */
export const tickStep_s = (scale: number) =>
  STEPS_S.find((step_s) => step_s * scale >= TICK_PX) ?? 7200;

/** The moments of the ticks between two places of the axis, in CSS pixels from its start; seconds. */
export function ticksBetween(axis: Axis, from_px: number, to_px: number): number[] {
  const step_s = tickStep_s(axis.scale);
  const first = Math.ceil(Math.max(axis.from_s, momentAt(axis, from_px)) / step_s - 1e-9);
  const last = Math.floor(Math.min(axis.to_s, momentAt(axis, to_px)) / step_s + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => (first + i) * step_s + 0);
}

/** Step of a drag that snaps to nothing, seconds: the least of a few round numbers that is two pixels wide, else 5. */
export const dragStep_s = (scale: number) =>
  [0.01, 0.05, 0.1, 0.5, 1].find((step_s) => step_s * scale >= 2) ?? 5;

/** The nearest of `moments` within `reach_s`, else the nearest multiple of `step_s`. */
export function snapMoment(
  at_s: number,
  moments: readonly number[],
  reach_s: number,
  step_s: number,
): number {
  let [best, distance_s] = [null as number | null, reach_s];
  for (const moment of moments) {
    const away_s = Math.abs(moment - at_s);
    if (away_s <= distance_s) [best, distance_s] = [moment, away_s];
  }
  return best ?? Math.round(at_s / step_s) * step_s;
}
