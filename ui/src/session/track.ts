import type { Dot, Point } from '../base/geometry';
import type { Robots } from '../api/types.gen';

/**
 * Where robots were measured, drawn smoothly. Robots report about twice a second: each is drawn on the line between
 * its last two places, one report late. Nothing is guessed ahead.
 */
export interface Track {
  push(robots: Robots, now_ms: number): void;
  /** What to draw at `now_ms`. `faded(robot)`: opacity of the robot with that row number, 0 to 1. */
  sample(now_ms: number, faded: (robot: number) => number): Sample;
  latest(): Robots | null;
}

/**
 * Robots (`filled`), their goals (`hollow`), and lines from robots to where they should be (`errors`), stage metres.
 * The next `sample` overwrites it; `hollow` is a new list only when a goal or a colour changed.
 */
export interface Sample {
  filled: Dot[];
  hollow: readonly Dot[];
  errors: [Point, Point][];
}

/** Robots between their last two reports, stage metres; one number a robot in every list, NaN where it is unknown. */
interface Legs {
  count: number;
  from: Places;
  to: Places;
  changed_ms: Float64Array;
  /** Duration of the drawn motion between the two reports. */
  lasts_ms: Float64Array;
  /** From the measured to the planned position, or to the goal without one; 0 without either. */
  off: Places;
}

interface Places {
  x: Float64Array;
  y: Float64Array;
}

/** A jump above this distance means that the robot was carried, metres. */
export const JUMP_M = 0.6;
/** Only errors above this get a line, metres: 1.5 times what a robot drives between two messages. */
const ERROR_MIN_M = 0.02;
/** A robot that drives reports at least this often, milliseconds. Also the longest drawn motion between two places. */
export const REPORT_MS = 700;
/** Least duration of a drawn motion, milliseconds. */
export const LEAST_MS = 50;

export function createTrack(): Track {
  let legs = noLegs(0);
  let now: Robots | null = null;
  let hollow: readonly Dot[] = [];
  // Drawn at each refresh of the screen: the same dots and lines are reused to spare memory.
  const dots: Dot[] = [];
  const lines: [Point, Point][] = [];
  const sample: Sample = { filled: [], hollow, errors: [] };

  const drawn = (i: number, now_ms: number, alpha: number): Dot => {
    const dot = (dots[i] ??= { x: 0, y: 0, color: 0, alpha: 1 });
    placeOn(legs, i, now_ms, dot);
    dot.color = now?.colour[i] ?? 0;
    dot.alpha = alpha;
    return dot;
  };
  const lineOf = (i: number, dot: Dot): [Point, Point] => {
    const line = (lines[i] ??= [dot, { x: 0, y: 0 }]);
    line[1].x = dot.x + at(legs.off.x, i);
    line[1].y = dot.y + at(legs.off.y, i);
    return line;
  };
  return {
    push(robots, now_ms) {
      if (legs.count !== robots.x.length) legs = noLegs(robots.x.length);
      for (let i = 0; i < legs.count; i++) advance(legs, robots, i, now_ms);
      if (!sameGoals(now, robots)) hollow = goalsOf(robots);
      now = robots;
    },
    latest: () => now,
    sample(now_ms, faded) {
      sample.filled.length = 0;
      sample.errors.length = 0;
      sample.hollow = hollow;
      for (let i = 0; i < legs.count; i++) {
        if (Number.isNaN(legs.to.x[i])) continue;
        const dot = drawn(i, now_ms, faded(i));
        sample.filled.push(dot);
        if (Math.hypot(at(legs.off.x, i), at(legs.off.y, i)) > ERROR_MIN_M)
          sample.errors.push(lineOf(i, dot));
      }
      return sample;
    },
  };
}

/** Element `i`, which must lie within the list. */
const at = (list: ArrayLike<number>, i: number) => list[i] as number;

function noLegs(count: number): Legs {
  const list = () => new Float64Array(count).fill(NaN);
  const places = (): Places => ({ x: list(), y: list() });
  return {
    count,
    from: places(),
    to: places(),
    changed_ms: list(),
    lasts_ms: list(),
    off: places(),
  };
}

/** Whether all goals and colours are as before, so that the drawn list can stay. */
function sameGoals(before: Robots | null, after: Robots): boolean {
  if (!before || before.goal_x.length !== after.goal_x.length) return false;
  for (let i = 0; i < after.goal_x.length; i++)
    if (
      !Object.is(before.goal_x[i], after.goal_x[i]) ||
      !Object.is(before.goal_y[i], after.goal_y[i]) ||
      before.colour[i] !== after.colour[i]
    )
      return false;
  return true;
}

function goalsOf({ goal_x, goal_y, colour }: Robots): Dot[] {
  const dots: Dot[] = [];
  for (let i = 0; i < goal_x.length; i++)
    if (!Number.isNaN(goal_x[i]))
      dots.push({ x: at(goal_x, i), y: at(goal_y, i), color: at(colour, i), alpha: 1 });
  return dots;
}

/** Writes the drawn position of a robot into `place`. */
function placeOn(
  { from, to, changed_ms, lasts_ms }: Legs,
  i: number,
  now_ms: number,
  place: Point,
) {
  const t = Math.max(0, Math.min(1, (now_ms - at(changed_ms, i)) / at(lasts_ms, i)));
  place.x = at(from.x, i) + (at(to.x, i) - at(from.x, i)) * t;
  place.y = at(from.y, i) + (at(to.y, i) - at(from.y, i)) * t;
}

/** The drawn position of a robot, overwritten by each `advance`. */
const here: Point = { x: 0, y: 0 };

function advance(legs: Legs, robots: Robots, i: number, now_ms: number) {
  const { from, to, changed_ms, lasts_ms } = legs;
  const [x, y] = [at(robots.x, i), at(robots.y, i)];
  const silent_ms = now_ms - at(changed_ms, i);
  if (x === to.x[i] && y === to.y[i]) {
    if (silent_ms > REPORT_MS) noteError(legs, robots, i);
    return;
  }
  const away_m = Math.hypot(x - at(to.x, i), y - at(to.y, i));
  // A position that was unknown, becomes unknown, or jumps is drawn at once.
  const jumps = !(away_m <= JUMP_M);
  if (jumps) [here.x, here.y] = [x, y];
  else placeOn(legs, i, now_ms, here);
  [from.x[i], from.y[i]] = [here.x, here.y];
  [to.x[i], to.y[i]] = [x, y];
  changed_ms[i] = now_ms;
  lasts_ms[i] = jumps ? LEAST_MS : Math.max(LEAST_MS, Math.min(REPORT_MS, silent_ms));
  noteError(legs, robots, i);
}

/** Notes the way from the measured position to the planned one, or without one to the goal; 0 without either. */
function noteError({ off }: Legs, robots: Robots, i: number) {
  const onPath = !Number.isNaN(robots.planned_x[i]);
  const meantX = at(onPath ? robots.planned_x : robots.goal_x, i);
  const meantY = at(onPath ? robots.planned_y : robots.goal_y, i);
  off.x[i] = Number.isNaN(meantX) ? 0 : meantX - at(robots.x, i);
  off.y[i] = Number.isNaN(meantY) ? 0 : meantY - at(robots.y, i);
}
