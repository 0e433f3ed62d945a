import { expect, test } from 'vitest';
import type { LogLine } from '../api/types.gen';
import { createLive, receive } from './live';

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
