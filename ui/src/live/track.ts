import type { Robots } from '../api/types.gen';
import type { Dot } from '../stage/scene';
import type { Point } from '../stage/camera';

/** Robots as they were said to be at a moment, and when the screen heard it. */
interface Heard {
  robots: Robots;
  heard_ms: number;
}

/** The last two snapshots: what is drawn lies between them, one interval late, so that motion is smooth. */
export interface Track {
  push(robots: Robots, now_ms: number): void;
  /** `stale[robot]`: 1 for robots to be drawn faded. */
  sample(now_ms: number, faded: (robot: number) => number): Sample;
  latest(): Robots | null;
}

export interface Sample {
  filled: Dot[];
  hollow: Dot[];
  errors: [Point, Point][];
}

/** A robot that jumps farther than this between snapshots is not drawn in between, metres. */
const JUMP_M = 0.25;
/** Errors below this are not worth a line, metres. */
const ERROR_MIN_M = 0.015;

export function createTrack(): Track {
  let before: Heard | null = null;
  let now: Heard | null = null;
  return {
    push(robots, now_ms) {
      const same = now !== null && now.robots.x.length === robots.x.length;
      before = same ? now : null;
      now = { robots, heard_ms: now_ms };
    },
    latest: () => now?.robots ?? null,
    sample(now_ms, faded) {
      if (!now) return { filled: [], hollow: [], errors: [] };
      const interval = before ? Math.min(250, Math.max(20, now.heard_ms - before.heard_ms)) : 50;
      const t = before ? Math.max(0, Math.min(1, (now_ms - now.heard_ms) / interval)) : 1;
      return sampleBetween(before?.robots ?? now.robots, now.robots, t, faded);
    },
  };
}

/** Places between two snapshots of the same robots; `t` in 0..1. */
export function sampleBetween(
  a: Robots,
  b: Robots,
  t: number,
  faded: (robot: number) => number,
): Sample {
  const sample: Sample = { filled: [], hollow: [], errors: [] };
  for (let i = 0; i < b.x.length; i++) {
    const color = b.colour[i] ?? 0;
    const at = between(a, b, i, t);
    const alpha = faded(i);
    if (at) sample.filled.push({ ...at, color, alpha });
    const goal = placeOf(b.goal_x[i], b.goal_y[i]);
    if (goal) sample.hollow.push({ ...goal, color, alpha: 1 });
    const meant = placeOf(b.planned_x[i], b.planned_y[i]) ?? goal;
    if (at && meant && Math.hypot(meant.x - at.x, meant.y - at.y) > ERROR_MIN_M)
      sample.errors.push([at, meant]);
  }
  return sample;
}

const placeOf = (x: number | null | undefined, y: number | null | undefined): Point | null =>
  typeof x === 'number' && typeof y === 'number' ? { x, y } : null;

function between(a: Robots, b: Robots, i: number, t: number): Point | null {
  const to = placeOf(b.x[i], b.y[i]);
  const from = placeOf(a.x[i], a.y[i]);
  if (!to || !from || Math.hypot(to.x - from.x, to.y - from.y) > JUMP_M) return to;
  return { x: from.x + (to.x - from.x) * t, y: from.y + (to.y - from.y) * t };
}
