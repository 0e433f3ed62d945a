import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { createSaver, type Saved } from './saver';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function setup(answers: Saved[]) {
  const puts: (string | null)[] = [];
  const saver = createSaver('"1"', async (etag) => {
    puts.push(etag);
    return answers.shift() ?? { ok: true, etag: `"${puts.length + 1}"` };
  });
  return { saver, puts, name: () => saver.state.get().name };
}

test('saves after a pause, and within a second however long people go on', async () => {
  const { saver, puts, name } = setup([]);
  for (let i = 0; i < 9; i++) {
    saver.touch();
    await vi.advanceTimersByTimeAsync(100);
  }
  expect(puts).toEqual(['"1"']);
  await vi.advanceTimersByTimeAsync(1000);
  expect(puts).toEqual(['"1"', '"2"']);
  expect(name()).toBe('saved');
});

test('a conflict overwrites nothing until people choose', async () => {
  const { saver, puts, name } = setup([{ ok: false, conflict: true, reason: '412' }]);
  saver.touch();
  await vi.advanceTimersByTimeAsync(400);
  expect(name()).toBe('conflict');
  saver.touch();
  saver.flush();
  await vi.advanceTimersByTimeAsync(10_000);
  expect(puts).toHaveLength(1);
  saver.rebase('"9"');
  await vi.advanceTimersByTimeAsync(10);
  expect(puts).toEqual(['"1"', '"9"']);
  expect(name()).toBe('saved');
});

test('a server that is away is tried again', async () => {
  const { saver, puts, name } = setup([{ ok: false, conflict: false, reason: 'away' }]);
  saver.touch();
  await vi.advanceTimersByTimeAsync(400);
  expect(name()).toBe('failed');
  await vi.advanceTimersByTimeAsync(2000);
  expect(puts).toHaveLength(2);
  expect(name()).toBe('saved');
});
