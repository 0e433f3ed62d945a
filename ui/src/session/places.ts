import type { Fleet, Plan, Robots } from '../api/types.gen';
import type { Point } from '../base/geometry';
import { countText } from '../base/numbers';
import { withRest } from '../model/frameIds';
import type { Show } from '../model/show';
import { nameOf } from './robotWords';

/** A robot no farther than this from a starting place counts as standing in it, metres. */
export const IN_PLACE_M = 0.05;
/** Most pairs of a robot elsewhere and a free place among which goals are searched; more would stop the page. */
const PAIRS_MAX = 250_000;

const dist = (a: Point, b: Point) => Math.hypot(a.x - b.x, a.y - b.y);

/** A robot and where it stands, stage metres. */
export interface Placed {
  name: string;
  at: Point;
}

/** Where robots stand against where the show expects them. */
export interface Comparison {
  /** Robots in a starting place. */
  inPlace: readonly Placed[];
  /**
   * Robots elsewhere, the farthest first. `goal`: the free place given to the robot, stage metres, `off_m` metres away.
   * Both are null without a place left for it, or with more than `PAIRS_MAX` pairs.
   */
  away: readonly (Placed & { goal: Point | null; off_m: number | null })[];
  /** Starting places that are no robot's place or goal. */
  free: readonly Point[];
  /** Names of robots without a known place. */
  unknown: readonly string[];
}

/** The starting places of a planned show, stage metres; null: the plan has no paths of the drive to the first frame. */
export function startsOf(plan: Plan | null): readonly Point[] | null {
  const first = plan?.transitions[0];
  if (!first || first.from !== null || first.paths.length === 0) return null;
  return first.paths.map(({ start: [x, y] }) => ({ x, y }));
}

/** Of the robots that report now: those with a known place, and the names of the others. */
export function placedRobots(fleet: Fleet, robots: Robots | null): [Placed[], string[]] {
  const placed: Placed[] = [];
  const unknown: string[] = [];
  fleet.rows.forEach((row, i) => {
    if (row.presence !== 'active') return;
    const at = { x: robots?.x[i] ?? NaN, y: robots?.y[i] ?? NaN };
    if (Number.isNaN(at.x + at.y)) unknown.push(nameOf(row));
    else placed.push({ name: nameOf(row), at });
  });
  return [placed, unknown];
}

/**
 * Matches robots to starting places: within `IN_PLACE_M` first, then the robots elsewhere to the free places. In both
 * rounds the nearest pairs come first, and a robot gets at most one place.
 */
export function comparePlaces(
  starts: readonly Point[],
  robots: readonly Placed[],
  unknown: readonly string[],
): Comparison {
  const near = pairsOf(robots, starts, IN_PLACE_M);
  const [inPlace, left, free] = matched(robots, starts, near);
  const isFew = left.length * free.length <= PAIRS_MAX;
  const goals = new Map<Placed, Point>();
  const [, , stillFree] = matched(left, free, isFew ? pairsOf(left, free, Infinity) : [], goals);
  const away = left.map((robot) => {
    const goal = goals.get(robot) ?? null;
    return { ...robot, goal, off_m: goal && dist(robot.at, goal) };
  });
  away.sort((a, b) => (b.off_m ?? Infinity) - (a.off_m ?? Infinity));
  return { inPlace, away, free: stillFree, unknown };
}

type Pair = readonly [off_m: number, robot: number, place: number];

/** Pairs of a robot and a place no farther apart than `most_m`, metres, the nearest first. */
function pairsOf(robots: readonly Placed[], places: readonly Point[], most_m: number): Pair[] {
  const isBounded = Number.isFinite(most_m);
  const cell = ({ x, y }: Point) =>
    isBounded ? ([Math.floor(x / most_m), Math.floor(y / most_m)] as const) : ([0, 0] as const);
  const cells = new Map<string, number[]>();
  places.forEach((place, i) => {
    const key = cell(place).join();
    const inside = cells.get(key);
    if (inside) inside.push(i);
    else cells.set(key, [i]);
  });
  const around = isBounded ? [-1, 0, 1] : [0];
  const pairs = robots.flatMap(({ at }, robot) => {
    const [u, v] = cell(at);
    const found = around.flatMap((du) =>
      around.flatMap((dv) => cells.get(`${u + du},${v + dv}`) ?? []),
    );
    return found.map((i): Pair => [dist(at, places[i] ?? at), robot, i]);
  });
  return pairs.filter(([off_m]) => off_m <= most_m).sort((a, b) => a[0] - b[0]);
}

/**
 * Gives each robot at most one place, in the order of the pairs, and adds it to `goals`. Answers the robots with a
 * place, the robots without, and the places left.
 */
function matched(
  robots: readonly Placed[],
  places: readonly Point[],
  pairs: readonly Pair[],
  goals = new Map<Placed, Point>(),
): [Placed[], Placed[], Point[]] {
  const [given, taken] = [new Set<number>(), new Set<number>()];
  for (const [, robot, place] of pairs) {
    if (given.has(robot) || taken.has(place)) continue;
    given.add(robot);
    taken.add(place);
    const [one, goal] = [robots[robot], places[place]];
    if (one && goal) goals.set(one, goal);
  }
  return [
    robots.filter((_, i) => given.has(i)),
    robots.filter((_, i) => !given.has(i)),
    places.filter((_, i) => !taken.has(i)),
  ];
}

/** What the comparison says, in one sentence. */
export function placesVerdict({ inPlace, away, free, unknown }: Comparison): string {
  const all = inPlace.length + away.length;
  if (all === 0) return 'No robot reports its place.';
  const parts = [`${inPlace.length} of ${countText(all, 'robot')} in their starting places`];
  if (away.length > 0) parts.push(`${away.length} elsewhere`);
  if (free.length > 0) parts.push(`${countText(free.length, 'place')} without a robot`);
  if (unknown.length > 0) parts.push(`${countText(unknown.length, 'robot')} without a known place`);
  return `${parts.join(', ')}.`;
}

/** The show with the places of these robots as starting places, rounded to a millimetre. */
export const withStarts = (show: Show, robots: readonly Placed[]): Show =>
  withRest(
    show,
    'starts',
    robots.map(({ at: { x, y } }) => [x, y].map((m) => Math.round(m * 1000) / 1000)),
  );
