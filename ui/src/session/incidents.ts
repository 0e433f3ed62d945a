import type { Fleet, Incident, Robots } from '../api/types.gen';
import type { Point } from '../base/geometry';
import { nameOf } from './robotWords';

/** Unread incidents, the newest first. */
export const unread = (incidents: readonly Incident[]): Incident[] =>
  incidents.filter((one) => !one.read).reverse();

/** Incidents that were read, the newest first. */
export const earlier = (incidents: readonly Incident[]): Incident[] =>
  incidents.filter((one) => one.read).reverse();

/** Whether an incident makes a sound: it is unread, not mere information, and its id is above `last`. */
export const isHeard = (incident: Incident, last: number): boolean =>
  incident.id > last && !incident.read && incident.tone !== 'information';

/** A robot that an incident names, and where it is on the floor, stage metres. */
export interface Callout extends Point {
  name: string;
}

/** Callouts drawn at once: more would hide the floor. */
const CALLOUTS_MAX = 12;

/** Unread incidents that still hold, the newest first. */
export const holding = (incidents: readonly Incident[]): Incident[] =>
  unread(incidents).filter((one) => !one.over);

/** Last result of `rowsOf`, with what it was found for: both change rarely, and the screen asks at every redraw. */
let found: { incidents: readonly Incident[]; fleet: Fleet; rows: readonly number[] } | null = null;

/** Indices in the fleet table of the robots that unread incidents which still hold name. */
function rowsOf(incidents: readonly Incident[], fleet: Fleet): readonly number[] {
  if (found?.incidents === incidents && found.fleet === fleet) return found.rows;
  const named = new Set(holding(incidents).flatMap((one) => one.robots));
  const rows = fleet.rows.flatMap((row, i) => (named.has(row.id) ? [i] : []));
  found = { incidents, fleet, rows };
  return rows;
}

/**
 * The robots that unread incidents which still hold name, in the fleet table's order. Robots without a known place are
 * left out, and so is what exceeds `CALLOUTS_MAX`.
 */
export function calloutsOf(
  incidents: readonly Incident[],
  fleet: Fleet,
  robots: Robots | null,
): Callout[] {
  if (robots === null) return [];
  return rowsOf(incidents, fleet)
    .flatMap((i) => {
      const [row, x, y] = [fleet.rows[i], robots.x[i] ?? NaN, robots.y[i] ?? NaN];
      return row === undefined || Number.isNaN(x + y) ? [] : [{ name: nameOf(row), x, y }];
    })
    .slice(0, CALLOUTS_MAX);
}
