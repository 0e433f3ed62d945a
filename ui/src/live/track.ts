import type { Robots } from '../api/types.gen';
import type { Point } from '../stage/camera';
import type { Dot } from '../stage/scene';

/**
 * Where robots were measured, drawn smoothly. Robots report about twice a second: each is drawn on its way between its
 * last two reports, one report late. Only measured places are drawn so; nothing is guessed ahead.
 */
export interface Track {
  push(robots: Robots, now_ms: number): void;
  /** `faded(robot)`: how strongly it is drawn, 0 to 1. */
  sample(now_ms: number, faded: (robot: number) => number): Sample;
  latest(): Robots | null;
}

export interface Sample {
  filled: Dot[];
  hollow: Dot[];
  errors: [Point, Point][];
}

/** One robot between its last two reports, stage metres. */
interface Leg {
  from: Point;
  to: Point;
  changed_ms: number;
  /** How long the way between the two is drawn. */
  lasts_ms: number;
  /** From where it was measured to where it was meant to be at that moment. */
  off: Point;
}

/** A robot that jumps farther than this was carried, not driven, metres. */
const JUMP_M = 0.6;
/** Errors below this are not worth a line, metres: a snapshot's worth of driving and half as much again. */
const ERROR_MIN_M = 0.02;
/** Reports come at least this often from a robot that drives, milliseconds. */
const REPORT_MS = 700;

export function createTrack(): Track {
  let legs: (Leg | null)[] = [];
  let now: Robots | null = null;
  return {
    push(robots, now_ms) {
      if (legs.length !== robots.x.length) legs = robots.x.map(() => null);
      legs = legs.map((leg, i) => advance(leg, robots, i, now_ms));
      now = robots;
    },
    latest: () => now,
    sample(now_ms, faded) {
      const sample: Sample = { filled: [], hollow: [], errors: [] };
      legs.forEach((leg, i) => {
        const color = now?.colour[i] ?? 0;
        const goal = placeOf(now?.goal_x[i], now?.goal_y[i]);
        if (goal) sample.hollow.push({ ...goal, color, alpha: 1 });
        if (!leg) return;
        const at = placeOn(leg, now_ms);
        sample.filled.push({ ...at, color, alpha: faded(i) });
        if (Math.hypot(leg.off.x, leg.off.y) > ERROR_MIN_M)
          sample.errors.push([at, { x: at.x + leg.off.x, y: at.y + leg.off.y }]);
      });
      return sample;
    },
  };
}

const placeOf = (x: number | null | undefined, y: number | null | undefined): Point | null =>
  typeof x === 'number' && typeof y === 'number' ? { x, y } : null;

function placeOn(leg: Leg, now_ms: number): Point {
  const t = Math.max(0, Math.min(1, (now_ms - leg.changed_ms) / leg.lasts_ms));
  return {
    x: leg.from.x + (leg.to.x - leg.from.x) * t,
    y: leg.from.y + (leg.to.y - leg.from.y) * t,
  };
}

function advance(leg: Leg | null, robots: Robots, i: number, now_ms: number): Leg | null {
  const to = placeOf(robots.x[i], robots.y[i]);
  if (!to) return null;
  const meant =
    placeOf(robots.planned_x[i], robots.planned_y[i]) ??
    placeOf(robots.goal_x[i], robots.goal_y[i]) ??
    to;
  const off = { x: meant.x - to.x, y: meant.y - to.y };
  if (!leg || Math.hypot(to.x - leg.to.x, to.y - leg.to.y) > JUMP_M)
    return { from: to, to, changed_ms: now_ms, lasts_ms: 50, off };
  const silent_ms = now_ms - leg.changed_ms;
  if (to.x === leg.to.x && to.y === leg.to.y) return silent_ms > REPORT_MS ? { ...leg, off } : leg;
  const lasts_ms = Math.max(50, Math.min(REPORT_MS, silent_ms));
  return { from: placeOn(leg, now_ms), to, changed_ms: now_ms, lasts_ms, off };
}
