import type { FleetRow } from '../api/types.gen';
import { ageText } from '../base/time';

/** The part of a robot's name that tells it apart on screen. */
export const shortId = (id: string) => (id.length > 12 ? id.slice(0, 8) : id);

const UUID = /\b([0-9a-f]{8})-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}\b/gi;

/** A line with the names in it shortened as everywhere on screen. */
export const shortNames = (text: string) => text.replace(UUID, '$1');

/** `now`, `4 s ago`. */
export const heardText = (row: FleetRow) => (row.age_s < 1.5 ? 'now' : `${ageText(row.age_s)} ago`);

/** What a robot says it is doing, or for how long it has been silent. */
export const stateText = (row: FleetRow) =>
  row.presence === 'active' ? row.status : `${presenceText(row)}, ${ageText(row.age_s)}`;

const PRESENCES = { active: 'here', stale: 'silent', gone: 'gone' } as const;

/** Whether it is here, as everywhere on screen. */
export const presenceText = (row: Pick<FleetRow, 'presence'>) => PRESENCES[row.presence];

export const chargeText = (row: FleetRow) => (row.battery === null ? '–' : `${row.battery} %`);

export const firmwareText = (row: FleetRow) => row.firmware ?? 'original';

/** What it can do beyond the original protocol. */
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
