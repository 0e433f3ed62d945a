import { expect, test } from 'vitest';
import type { FleetRow } from '../api/types.gen';
import * as words from './robotWords';

test('names are short wherever they stand', () => {
  const id = 'abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8';
  expect(words.shortId(id)).toBe('abfe6805');
  expect(words.shortId('robot-7')).toBe('robot-7');
  expect(words.shortNames(`Waiting for ${id}: it is behind.`)).toBe(
    'Waiting for abfe6805: it is behind.',
  );
});

test('an original robot is described too', () => {
  const row: FleetRow = {
    id: 'r',
    status: 'idle',
    presence: 'stale',
    age_s: 9,
    battery: null,
    battery_left_s: null,
    pixel: null,
    firmware: null,
    abilities: { route: false, fade: false, blink: false },
    clock_us: null,
    called: null,
    admitted: true,
    simulated: false,
    preflight: null,
  };
  expect(words.stateText(row)).toBe('silent, 9 s');
  expect(words.abilitiesText(row)).toBe('targets and colours');
  expect([words.chargeText(row), words.firmwareText(row), words.clockText(row)]).toEqual(
    ['–', 'original', 'not set'], // prettier-ignore
  );
  expect(words.lastSeenText({ ...row, age_s: 0 })).toBe('just now');
});
