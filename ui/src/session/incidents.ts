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

/** Where the robots of unread incidents are, as far as that is known. */
export function calloutsOf(
  incidents: readonly Incident[],
  fleet: Fleet,
  robots: Robots | null,
): Callout[] {
  if (robots === null) return [];
  const named = new Set(
    unread(incidents)
      .filter((one) => !one.over)
      .flatMap((one) => one.robots),
  );
  if (named.size === 0) return [];
  const callouts: Callout[] = [];
  fleet.rows.forEach((row, i) => {
    if (!named.has(row.id) || callouts.length === CALLOUTS_MAX) return;
    const [x, y] = [robots.x[i] ?? NaN, robots.y[i] ?? NaN];
    if (!Number.isNaN(x + y)) callouts.push({ name: nameOf(row), x, y });
  });
  return callouts;
}
