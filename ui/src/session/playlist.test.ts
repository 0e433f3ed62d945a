import { expect, test } from 'vitest';
import type { PlaylistEntry, PlaylistState } from '../api/types.gen';
import { moved, nextText, resultText, startText, switchQuestion } from './playlist';

const entry = (more: Partial<PlaylistEntry>): PlaylistEntry => ({
  id: 1,
  show: 'heart',
  speed_percent: 100,
  ...more,
});

const state = (more: Partial<PlaylistState>): PlaylistState => ({
  revision: 1,
  on: true,
  entries: [],
  today: [],
  next: null,
  held: null,
  fault: null,
  now: '19:00',
  ...more,
});

test('when an entry starts', () => {
  expect(startText(entry({ at: '19:00' }))).toBe('19:00 every day');
  expect(startText(entry({ at: '19:00', weekdays: ['sun', 'fri'] }))).toBe('19:00 Fr Su');
  expect(startText(entry({ pause_min: 0 }))).toBe('Right after the show before');
  expect(startText(entry({ pause_min: 20 }))).toBe('20 min after the show before');
  expect(startText(entry({ pause_min: 20, home: true }))).toBe(
    'Home, then 20 min after the show before',
  );
});

test('what became of it today', () => {
  expect(resultText({ result: 'waiting', time: null, line: null })).toBe('To come');
  expect(resultText({ result: 'waiting', time: '19:30', line: null })).toBe('Starts 19:30');
  expect(resultText({ result: 'played', time: '19:10', line: null })).toBe('Played 19:10');
});

test('what starts next, and the question before it', () => {
  const next = { id: 1, show: 'heart', time: '19:00', in_s: 754 };
  const say = (left_s: number) => nextText({ state: state({ next }), seen_ms: 0 }, left_s);
  expect(say(754)).toBe('Next: heart at 19:00, in 12:34.');
  expect(say(12_000)).toBe('Next: heart at 19:00, in 3 h 20 min.');
  expect(say(260_000)).toBe('Next: heart at 19:00, in 3 days.');
  expect(say(0.5)).toBe('heart starts now.');
  expect(nextText({ state: state({}), seen_ms: 0 }, null)).toBe('Nothing is to come.');
  const playing = state({
    next,
    entries: [entry({})],
    today: [{ result: 'playing', time: '19:00', line: null }],
  });
  expect(nextText({ state: playing, seen_ms: 0 }, 3)).toBe('heart plays now.');
  expect(switchQuestion(state({ next }), '60 real robots')).toMatch(
    /^60 real robots start by themselves at 19:00: heart\./,
  );
  expect(switchQuestion(state({ next: { ...next, in_s: 0 } }), 'Robots')).toMatch(/at once/);
});

test('an entry moves within the list only', () => {
  const list = [entry({ id: 1 }), entry({ id: 2 }), entry({ id: 3 })];
  const ids = (from: number, by: -1 | 1) => moved(list, from, by).map(({ id }) => id);
  expect([ids(0, 1), ids(2, -1), ids(0, -1), ids(2, 1)]).toEqual([
    [2, 1, 3],
    [1, 3, 2],
    [1, 2, 3],
    [1, 2, 3],
  ]);
});
