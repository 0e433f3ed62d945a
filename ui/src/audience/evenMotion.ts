import { ROBOT_STATUSES, type Robots } from '../api/types.gen';
import { mix, type Rgb } from '../base/colour';
import type { Dot } from '../base/geometry';
import { JUMP_M, LEAST_MS, REPORT_MS } from '../session/track';

/**
 * Measured lights, drawn so that they move evenly. Robots report about twice a second. A robot is drawn on a cubic
 * curve from where it is drawn to its newest place, without a jolt. The curve lasts a little longer than reports
 * take: a late one must not stop the drawn robot. Nothing is guessed ahead. Colours fade between messages.
 */
export interface EvenMotion {
  /** Takes the places and colours of a message that came at `now_ms`. */
  push(robots: Robots, now_ms: number): void;
  /** The lights of robots with a known place for which `isShown` is true. The next call overwrites the list. */
  sample(now_ms: number, isShown: (robot: number) => boolean): readonly Dot[];
  /** Whether nothing moves or changes its colour from this moment until the next `push`. */
  isStill(now_ms: number): boolean;
}

/** A robot on its curve. Places in stage metres, velocities in metres a millisecond, times of the page's clock. */
interface Curve {
  from: State;
  to: State;
  began_ms: number;
  lasts_ms: number;
  /** When the robot last reported a new place. */
  reported_ms: number;
}

/** Place and velocity. */
interface State {
  x: number;
  y: number;
  vx: number;
  vy: number;
}

/** Duration of a curve, in times between the last two new places: enough for reports that jitter by a tenth. */
const LONGER = 1.2;
/** Largest speed at the begin of a curve, in mean speeds of the curve: a faster one would overshoot the end. */
const FASTER_MAX = 3;
/** Least time of a change of colours, milliseconds; else it takes as long as the time between the last two messages. */
const COLOUR_MIN_MS = 16;
/** Longest time of a change of colours, milliseconds. */
const COLOUR_MAX_MS = 100;

export function createEvenMotion(): EvenMotion {
  let curves: Curve[] = [];
  let [before, after]: [Rgb[], Rgb[]] = [[], []];
  let [coloured_ms, changes_ms] = [-Infinity, COLOUR_MIN_MS];
  let restless_ms = -Infinity;
  const dots: Dot[] = [];
  const shown: Dot[] = [];
  const at: State = { x: 0, y: 0, vx: 0, vy: 0 };
  const colourAt = (i: number, now_ms: number): Rgb => {
    const [a, b] = [before[i] ?? 0, after[i] ?? 0];
    return a === b ? b : mix(a, b, Math.min(1, Math.max(0, (now_ms - coloured_ms) / changes_ms)));
  };
  const takeColours = ({ colour }: Robots, now_ms: number) => {
    const next = Array.from(colour);
    const drawn = next.map((c, i) => (i < after.length ? colourAt(i, now_ms) : c));
    changes_ms = Math.max(COLOUR_MIN_MS, Math.min(COLOUR_MAX_MS, now_ms - coloured_ms));
    [before, after, coloured_ms] = [drawn, next, now_ms];
    if (next.some((c, i) => c !== drawn[i]))
      restless_ms = Math.max(restless_ms, now_ms + changes_ms);
  };
  return {
    push(robots, now_ms) {
      const count = robots.x.length;
      if (curves.length !== count) curves = Array.from({ length: count }, () => standing(NaN, NaN));
      takeColours(robots, now_ms);
      curves.forEach((curve, i) => {
        const status = ROBOT_STATUSES[robots.status[i] ?? 0];
        const goesOn = status === 'driving' || status === 'held';
        advance(curve, robots.x[i] ?? NaN, robots.y[i] ?? NaN, goesOn, now_ms);
        restless_ms = Math.max(restless_ms, curve.began_ms + curve.lasts_ms);
      });
    },
    sample(now_ms, isShown) {
      shown.length = 0;
      curves.forEach((curve, i) => {
        if (Number.isNaN(curve.to.x) || !isShown(i)) return;
        stateOn(curve, now_ms, at);
        const dot = (dots[i] ??= { x: 0, y: 0, color: 0, alpha: 1 });
        [dot.x, dot.y, dot.color] = [at.x, at.y, colourAt(i, now_ms)];
        shown.push(dot);
      });
      return shown;
    },
    isStill: (now_ms) => now_ms > restless_ms,
  };
}

const standing = (x: number, y: number): Curve => ({
  from: { x, y, vx: 0, vy: 0 },
  to: { x, y, vx: 0, vy: 0 },
  began_ms: -Infinity,
  lasts_ms: 1,
  reported_ms: -Infinity,
});

/** Writes the state of a robot on its curve at a moment into `state`; past the end it stands there. */
function stateOn({ from, to, began_ms, lasts_ms }: Curve, now_ms: number, state: State) {
  const s = Math.max(0, (now_ms - began_ms) / lasts_ms);
  if (s >= 1) {
    [state.x, state.y, state.vx, state.vy] = [to.x, to.y, 0, 0];
    return;
  }
  [state.x, state.vx] = hermite(from.x, from.vx, to.x, to.vx, s, lasts_ms);
  [state.y, state.vy] = hermite(from.y, from.vy, to.y, to.vy, s, lasts_ms);
}

/** Place and velocity at the share `s` of a cubic Hermite curve between two places with their velocities. */
function hermite(
  p0: number,
  v0: number,
  p1: number,
  v1: number,
  s: number,
  lasts_ms: number,
): [place: number, velocity: number] {
  const [m0, m1] = [v0 * lasts_ms, v1 * lasts_ms];
  const [square, cube] = [s * s, s * s * s];
  const place =
    (2 * cube - 3 * square + 1) * p0 +
    (cube - 2 * square + s) * m0 +
    (3 * square - 2 * cube) * p1 +
    (cube - square) * m1;
  const slope =
    (6 * square - 6 * s) * (p0 - p1) + (3 * square - 4 * s + 1) * m0 + (3 * square - 2 * s) * m1;
  return [place, slope / lasts_ms];
}

/** Begins a curve to a new place that a robot reported. `goesOn`: the robot drives on after that place. */
function advance(curve: Curve, x: number, y: number, goesOn: boolean, now_ms: number) {
  const { from, to } = curve;
  if (Object.is(x, to.x) && Object.is(y, to.y)) return;
  const away_m = Math.hypot(x - to.x, y - to.y);
  // A place that was unknown, becomes unknown, or jumps is drawn at once.
  if (!(away_m <= JUMP_M)) {
    Object.assign(curve, standing(x, y), { reported_ms: now_ms });
    return;
  }
  stateOn(curve, now_ms, from);
  // Limited, because after a stand the time since the last new place says nothing about the period of reports.
  const apart_ms = Math.max(LEAST_MS, Math.min(REPORT_MS, now_ms - curve.reported_ms));
  curve.began_ms = curve.reported_ms = now_ms;
  curve.lasts_ms = apart_ms * LONGER;
  const [meanX, meanY] = [(x - from.x) / curve.lasts_ms, (y - from.y) / curve.lasts_ms];
  const mean = Math.hypot(meanX, meanY);
  const speed = Math.hypot(from.vx, from.vy);
  if (speed > FASTER_MAX * mean) {
    from.vx *= (FASTER_MAX * mean) / speed;
    from.vy *= (FASTER_MAX * mean) / speed;
  }
  // A quarter of the way from a constant speed to a constant acceleration, which swings if reports jitter.
  let [vx, vy] = [1.25 * meanX - 0.25 * from.vx, 1.25 * meanY - 0.25 * from.vy];
  if (!goesOn || vx * meanX + vy * meanY < 0) [vx, vy] = [0, 0];
  [to.x, to.y, to.vx, to.vy] = [x, y, vx, vy];
}
