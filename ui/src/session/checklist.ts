import { countText } from '../base/numbers';
import type { Broker, FleetRow, Plan, Robots } from '../api/types.gen';
import { fleetSize, pinsOf, sparesOf } from '../model/commands';
import type { Show } from '../model/show';
import { chargeText, nameOf } from './robotWords';

/** `good`: fine; `wait`: not known yet; `warn`: playable with a risk; `bad`: at least part of the show cannot play. */
export type Verdict = 'good' | 'wait' | 'warn' | 'bad';

/** One check before robots move. */
export interface Check {
  name: 'broker' | 'plan' | 'robots' | 'places' | 'pins' | 'batteries';
  title: string;
  verdict: Verdict;
  /** The state, and what to do where it is not good. */
  detail: string;
}

export interface Situation {
  broker: Broker;
  show: Show | null;
  plan: Plan | null;
  rows: readonly FleetRow[];
  /** Places in the order of `rows`, NaN where they are unknown. */
  robots: Pick<Robots, 'x'> | null;
}

/** Charge below which a battery counts as low, percent. */
export const CHARGE_LOW = 20;

/** Robots in these states do not drive. */
const UNFIT = ['cut', 'faulty'];

export const canDrive = (row: FleetRow) => row.presence === 'active' && !UNFIT.includes(row.status);

/** The checks before a start, in the order in which to fix problems. Without a show: one check that says so. */
export function checklistOf(s: Situation): Check[] {
  if (!s.show) return [check('plan', 'Show', 'bad', 'No show is open: open one first.')];
  return [
    brokerCheck(s.broker),
    planCheck(s.plan),
    robotsCheck(s.show, s.rows),
    placesCheck(s.show, s),
    ...pinsCheck(s.show, s.rows),
    batteryCheck(s.rows, s.plan),
  ];
}

/** Whether the show can start without a question: a check that waits is no obstacle, because the start waits too. */
export const isReady = (checks: readonly Check[]) =>
  checks.every(({ verdict }) => verdict === 'good' || verdict === 'wait');

/** Whether the show can start although robots, positions or pinned robots are missing: no other check may be bad. */
export const canGoOn = (checks: readonly Check[]) =>
  checks.every(
    (c) => c.verdict !== 'bad' || c.name === 'robots' || c.name === 'places' || c.name === 'pins',
  );

const check = (name: Check['name'], title: string, verdict: Verdict, detail: string): Check => ({
  name,
  title,
  verdict,
  detail,
});

function brokerCheck(broker: Broker): Check {
  const off = broker.phase === 'off';
  const lost = off ? 'Off: press Connect in Settings.' : (broker.reason ?? 'Connecting…');
  return broker.connected
    ? check('broker', 'Broker connected', 'good', broker.node ?? broker.address)
    : check('broker', 'Broker', 'bad', lost);
}

function planCheck(plan: Plan | null): Check {
  if (!plan || plan.planning) return check('plan', 'Plan', 'wait', 'Planning…');
  const wrong = plan.issues.filter((i) => i.severity === 'error');
  const first = wrong[0]?.message ?? 'See the issues in the tab Show.';
  const more = wrong.length > 1 ? ` And ${wrong.length - 1} more, in the tab Show.` : '';
  if (!plan.ok || wrong.length > 0)
    return check('plan', 'Plan', 'bad', `Fix before playing: ${first}${more}`);
  const closest =
    plan.closest_m === null
      ? 'No two robots pass each other.'
      : `Closest approach ${(plan.closest_m * 1000).toFixed(0)} mm.`;
  return check('plan', 'Collision-free', 'good', closest);
}

function robotsCheck(show: Show, rows: readonly FleetRow[]): Check {
  const needed = fleetSize(show);
  const spares = sparesOf(show);
  const ready = rows.filter(canDrive).length;
  const count = `${ready} of ${needed}`;
  if (ready >= needed + spares)
    return check('robots', 'Robots ready', 'good', `${ready} of ${needed + spares}`);
  if (ready >= needed) {
    const few = `${ready - needed} of ${countText(spares, 'spare robot')}`;
    return check('robots', 'Robots ready', 'warn', `${needed} of ${needed}, and ${few}.`);
  }
  const silent = rows.filter((row) => row.presence !== 'active').length;
  const unfit = rows.length - ready - silent;
  const why = [
    silent > 0 ? `${silent} silent` : '',
    unfit > 0 ? `${unfit} faulty` : '',
    needed > rows.length ? `${needed - rows.length} missing` : '',
  ].filter(Boolean);
  const advice = 'Turn them on and press Refresh, or play without their pixels.';
  return check('robots', 'Robots', 'bad', `${count} ready: ${why.join(', ')}. ${advice}`);
}

function placesCheck(show: Show, { rows, robots }: Situation): Check {
  const lost = rows.filter(
    (row, i) => canDrive(row) && (row.status === 'lost' || Number.isNaN(robots?.x[i] ?? NaN)),
  );
  if (lost.length === 0)
    return check('places', 'Positions known', 'good', 'All robots know their position.');
  const spare = rows.filter(canDrive).length - lost.length >= fleetSize(show);
  const names = lost.slice(0, 3).map((row) => row.id.slice(0, 8));
  const more = lost.length > 3 ? ` and ${lost.length - 3} more` : '';
  const advice = 'Move it into sight of the positioning system, or play without it.';
  return check(
    'places',
    'Positions',
    spare ? 'warn' : 'bad',
    `Unknown for ${names.join(', ')}${more}. ${advice}`,
  );
}

/** The check of pinned robots; empty where the show pins no pixel. */
function pinsCheck(show: Show, rows: readonly FleetRow[]): Check[] {
  const pins = [...pinsOf(show)];
  if (pins.length === 0) return [];
  const here = new Set(rows.filter(canDrive).map((row) => row.id));
  const missing = pins.filter(([, robot]) => !here.has(robot));
  if (missing.length === 0)
    return [check('pins', 'Pinned robots here', 'good', `All ${pins.length}.`)];
  const [pixel, robot] = missing[0] ?? [0, ''];
  const more = missing.length > 1 ? ` and ${missing.length - 1} more` : '';
  const detail = `Pixel ${pixel} is pinned to ${robot.slice(0, 8)}${more}, which is not here. Remove the pin, or play without it.`;
  return [check('pins', 'Pinned robots', 'bad', detail)];
}

/** Minutes by which a battery has to outlast the show. */
const SPARE_MIN = 5;

function batteryCheck(rows: readonly FleetRow[], plan: Plan | null): Check {
  const known = rows.filter((row) => canDrive(row) && row.battery !== null);
  if (known.length === 0) return check('batteries', 'Batteries', 'good', 'No battery information.');
  const show_min = (plan?.duration_s ?? 0) / 60;
  const left_min = (row: FleetRow) => (row.battery_left_s ?? Infinity) / 60;
  const short = known.filter((row) => left_min(row) < show_min + SPARE_MIN);
  const low = known.filter((row) => (row.battery ?? 100) < CHARGE_LOW || short.includes(row));
  const least = Math.min(...known.map((row) => row.battery ?? 100));
  const shortest_min = Math.min(...known.map(left_min));
  const lasts = shortest_min === Infinity ? '' : `, ${Math.floor(shortest_min)} min`;
  if (low.length === 0)
    return check('batteries', 'Batteries', 'good', `At least ${least} %${lasts}.`);
  const names = low.slice(0, 3).map((row) => `${nameOf(row)} has ${chargeText(row)}`);
  const more = low.length > 3 ? ` and ${low.length - 3} more are low` : '';
  const takes = short.length > 0 ? ` The show takes ${Math.ceil(show_min)} min.` : '';
  const detail = `${names.join('; ')}${more}.${takes} Charge or swap them.`;
  return check('batteries', 'Batteries', 'warn', detail);
}
