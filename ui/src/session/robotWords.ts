import type { FleetRow } from '../api/types.gen';
import { ageText } from '../base/time';

/** A robot's id as screens show it: whole up to 12 characters, else its first 8. */
export const shortId = (id: string) => (id.length > 12 ? id.slice(0, 8) : id);

/** What people call a robot: the name that they gave it, else its short id. */
export const nameOf = (row: Pick<FleetRow, 'id' | 'called'>) => row.called ?? shortId(row.id);

/** The text with the short ids of `robots` replaced by the names that people gave them; an id without a name stays. */
export const withNames = (text: string, robots: readonly string[], rows: readonly FleetRow[]) =>
  robots.reduce((said, id) => {
    const called = rows.find((row) => row.id === id)?.called;
    return called ? said.replaceAll(shortId(id), called) : said;
  }, text);

const UUID = /\b([0-9a-f]{8})-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}\b/gi;

/** A text with the robots' ids shortened. */
export const shortNames = (text: string) => text.replace(UUID, '$1');

/** `just now`, `4 s ago`: the time since the last report. */
export const lastSeenText = (row: FleetRow) =>
  row.age_s < 1.5 ? 'just now' : `${ageText(row.age_s)} ago`;

/** The state that a robot reports, or the time since its last report. */
export const stateText = (row: FleetRow) =>
  row.presence === 'active' ? row.status : `${presenceText(row)}, ${ageText(row.age_s)}`;

const PRESENCES = { active: 'here', stale: 'silent', gone: 'gone' } as const;

/** The word for a robot's presence. */
export const presenceText = (row: Pick<FleetRow, 'presence'>) => PRESENCES[row.presence];

/** Charge in percent, and the minutes that it lasts once they are known; `–`: the charge is unknown. */
export const chargeText = (row: FleetRow) => {
  if (row.battery === null) return '–';
  const left = row.battery_left_s === null ? '' : `, ${Math.floor(row.battery_left_s / 60)} min`;
  return `${row.battery} %${left}`;
};

export const firmwareText = (row: FleetRow) => row.firmware ?? 'original';

/** Abilities of a robot beyond the original protocol. */
export function abilitiesText({ abilities }: FleetRow): string {
  const words = [
    abilities.route ? 'paths' : '',
    abilities.fade ? 'fades' : '',
    abilities.blink ? 'blinks' : '',
  ].filter(Boolean);
  return words.length > 0 ? words.join(', ') : 'targets and colours';
}

export const clockText = (row: FleetRow) =>
  row.clock_us === null ? 'not set' : `± ${(row.clock_us / 1000).toFixed(1)} ms`;
