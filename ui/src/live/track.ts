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

/** Filled in anew by the next `sample`; `hollow` is another list only when a goal changed. */
export interface Sample {
  filled: Dot[];
  hollow: readonly Dot[];
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
  let hollow: readonly Dot[] = [];
  // Drawn sixty times a second: the same dots are filled in again and again.
  const dots: Dot[] = [];
  const sample: Sample = { filled: [], hollow, errors: [] };
  return {
    push(robots, now_ms) {
      if (legs.length !== robots.x.length) legs = robots.x.map(() => null);
      for (let i = 0; i < legs.length; i++) legs[i] = advance(legs[i] ?? null, robots, i, now_ms);
      if (!sameGoals(now, robots)) hollow = goalsOf(robots);
      now = robots;
    },
    latest: () => now,
    sample(now_ms, faded) {
      sample.filled.length = 0;
      sample.errors.length = 0;
      sample.hollow = hollow;
      for (let i = 0; i < legs.length; i++) {
        const leg = legs[i];
        if (!leg) continue;
        const dot = (dots[i] ??= { x: 0, y: 0, color: 0, alpha: 1 });
        placeOn(leg, now_ms, dot);
        dot.color = now?.colour[i] ?? 0;
        dot.alpha = faded(i);
        sample.filled.push(dot);
        if (Math.hypot(leg.off.x, leg.off.y) > ERROR_MIN_M)
          sample.errors.push([dot, { x: dot.x + leg.off.x, y: dot.y + leg.off.y }]);
      }
      return sample;
    },
  };
}

/** Goals change once a frame, and their lights with a fade: all else leaves them as they were drawn. */
function sameGoals(before: Robots | null, after: Robots): boolean {
  if (!before || before.goal_x.length !== after.goal_x.length) return false;
  for (let i = 0; i < after.goal_x.length; i++)
    if (
      before.goal_x[i] !== after.goal_x[i] ||
      before.goal_y[i] !== after.goal_y[i] ||
      before.colour[i] !== after.colour[i]
    )
      return false;
  return true;
}

function goalsOf(robots: Robots): Dot[] {
  const dots: Dot[] = [];
  robots.goal_x.forEach((x, i) => {
    const goal = placeOf(x, robots.goal_y[i]);
    if (goal) dots.push({ ...goal, color: robots.colour[i] ?? 0, alpha: 1 });
  });
  return dots;
}

const placeOf = (x: number | null | undefined, y: number | null | undefined): Point | null =>
  typeof x === 'number' && typeof y === 'number' ? { x, y } : null;

/** Puts where a robot is drawn into `at`. */
function placeOn<P extends Point>(leg: Leg, now_ms: number, at: P): P {
  const t = Math.max(0, Math.min(1, (now_ms - leg.changed_ms) / leg.lasts_ms));
  at.x = leg.from.x + (leg.to.x - leg.from.x) * t;
  at.y = leg.from.y + (leg.to.y - leg.from.y) * t;
  return at;
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
  return { from: placeOn(leg, now_ms, { x: 0, y: 0 }), to, changed_ms: now_ms, lasts_ms, off };
}
