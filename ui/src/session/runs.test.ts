import { expect, test } from 'vitest';
import type { RunEntry } from '../api/types.gen';
import { offeredRun, runOutcome, runTitle } from './runs';

const run = (of: Partial<RunEntry>): RunEntry => ({
  number: 1,
  kind: 'show',
  show: 'Hello',
  began_ms: 1000,
  ended_ms: 61_000,
  ok: true,
  outcome: 'All 2 frames shown, no robot lost.',
  has_report: true,
  ...of,
});

test('the report of the last show is offered until it is dismissed', () => {
  const home = run({ number: 3, kind: 'home', began_ms: 9000 });
  const shows = [home, run({ number: 2, began_ms: 5000 }), run({})];
  expect(offeredRun(shows, '')?.number).toBe(2);
  expect(offeredRun(shows, '5000')).toBe(null);
  expect(offeredRun(shows, '1000')?.number).toBe(2);
  expect(offeredRun([run({ ended_ms: null }), run({})], '')).toBe(null);
  expect(offeredRun([run({ has_report: false })], '')).toBe(null);
  expect(offeredRun([], '')).toBe(null);
});

test('a run is told by its kind, its show and its end', () => {
  expect(runTitle(run({ kind: 'home' }))).toBe('Home in Hello');
  expect(runTitle(run({ show: ' ' }))).toBe('a show');
  expect(runOutcome(run({ outcome: null }), true)).toBe('It is on.');
  expect(runOutcome(run({ outcome: null }), false)).toBe('Its program ended before it did.');
  expect(runOutcome(run({}), false)).toBe('All 2 frames shown, no robot lost.');
});
