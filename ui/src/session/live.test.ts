import { expect, test } from 'vitest';
import type { LogLine } from '../api/types.gen';
import { createLive, receive } from './live';
import { planOf } from './plan.testing';

const line = (id: number, text: string): LogLine => ({
  id,
  time_ms: 0,
  level: 'info',
  text,
  count: 0,
  robots: [],
});

test('a line of the log that grows stays where it is, and the log does not grow with it', () => {
  const live = createLive();
  const say = (id: number, text: string) => receive(live, { type: 'log', ...line(id, text) });
  say(1, 'Robot a is here.');
  say(2, 'A show is open.');
  for (let count = 2; count <= 1000; count++) say(1, `${count} robots are here.`);
  expect(live.log.get().map(({ text }) => text)).toEqual([
    '1000 robots are here.',
    'A show is open.',
  ]);
});

test('a finished plan that comes before its show is the plan of that show', () => {
  const live = createLive();
  const open = (revision: number, name: string) =>
    receive(live, { type: 'show', revision, name, etag: '"1"', read_only: null, document: {} });
  receive(live, { type: 'plan', ...planOf(1) });
  open(1, 'A');
  expect(live.settled.get()?.revision).toBe(1);
  open(2, 'B');
  expect(live.settled.get()).toBeNull();
  const hello = { version: '1', screen: 1, simulated: 0, plain_http: false };
  receive(live, { type: 'hello', ...hello });
  open(1, 'C');
  expect(live.settled.get()).toBeNull();
});
