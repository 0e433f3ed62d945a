import type { Fleet, Incident, Robots } from '../api/types.gen';
import type { Point } from '../base/geometry';
import { nameOf } from './robotWords';

/** Unread incidents, the newest first. */
export const unread = (incidents: readonly Incident[]): Incident[] =>
  incidents.filter((one) => !one.read).reverse();

/** Incidents that were read, the newest first. */
export const earlier = (incidents: readonly Incident[]): Incident[] =>
  incidents.filter((one) => one.read).reverse();

/** Incidents for which a sound is made: what has to be looked at, and newer than the last one heard. */
export const isHeard = (incident: Incident, last: number): boolean =>
  incident.id > last && !incident.read && incident.tone !== 'information';

/** A robot of an incident on the floor. */
export interface Callout extends Point {
  name: string;
}

/** Callouts drawn at once: more would hide the floor. */
const CALLOUTS_MAX = 12;

/** Unread incidents that still hold, the newest first. */
export const holding = (incidents: readonly Incident[]): Incident[] =>
  unread(incidents).filter((one) => !one.over);

/** Incidents and fleet table for which rows were found last: both change rarely, and callouts are drawn in every frame. */
let found: { incidents: readonly Incident[]; fleet: Fleet; rows: readonly number[] } | null = null;

/** Rows of the robots of incidents that hold. */
function rowsOf(incidents: readonly Incident[], fleet: Fleet): readonly number[] {
  if (found?.incidents === incidents && found.fleet === fleet) return found.rows;
  const named = new Set(holding(incidents).flatMap((one) => one.robots));
  const rows = fleet.rows.flatMap((row, i) => (named.has(row.id) ? [i] : []));
  found = { incidents, fleet, rows };
  return rows;
}

/** Where the robots of incidents that hold are, as far as that is known. */
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
