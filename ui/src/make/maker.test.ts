import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import type { MakeAnswer, MakeRequest } from '../api/types.gen';
import { createMaker, GRACE_MS, MAKE_MAX_MS, type MakeWorker } from './maker';
import type { Ask, Reply } from './protocol';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

interface FakeWorker extends MakeWorker {
  asks: Ask[];
  ended: boolean;
  answer(reply: Reply): void;
}

/** A maker, and the workers that it started, which answer when the test calls `answer`. */
function workers() {
  const started: FakeWorker[] = [];
  const start = () => {
    const worker: FakeWorker = {
      asks: [],
      ended: false,
      onmessage: null,
      onerror: null,
      postMessage: (ask) => void worker.asks.push(ask),
      terminate: () => void (worker.ended = true),
      answer: (data) => worker.onmessage?.({ data } as MessageEvent<Reply>),
    };
    started.push(worker);
    return worker;
  };
  return { started, maker: createMaker(start) };
}

const wish = (robots: number): MakeRequest => ({ show: {}, robots, quality: 'full' });
const made = (size_m: number): { of: 'make'; answer: MakeAnswer } => ({
  of: 'make',
  answer: {
    pixels: [],
    size_m,
    closest_m: null,
    readability: null,
    enough: null,
    notes: [],
    error: null,
  },
});

test('one frame is made at a time, and only the newest of those that wait', async () => {
  const { started, maker } = workers();
  expect(started).toHaveLength(0);
  const answers = [1, 2, 3].map((robots) => maker.make(wish(robots), null));
  const [worker] = started;
  expect(worker?.asks).toHaveLength(1);
  worker?.answer(made(0.1));
  worker?.answer(made(0.3));
  const sizes = (await Promise.all(answers)).map((answer) => answer?.size_m ?? null);
  expect(sizes).toEqual([0.1, null, 0.3]);
  expect(worker?.asks.map((ask) => (ask.do === 'make' ? ask.request.robots : 0))).toEqual([1, 3]);
});

test('a newer wish ends a long one after a moment, in a new worker', async () => {
  const { started, maker } = workers();
  const [old, young] = [maker.make(wish(1), null), maker.make(wish(2), null)];
  await vi.advanceTimersByTimeAsync(GRACE_MS);
  expect(await old).toBeNull();
  expect(started.map((worker) => worker.ended)).toEqual([true, false]);
  started[1]?.answer(made(0.2));
  expect((await young)?.size_m).toBe(0.2);
});

test('what takes too long is given up and says so; the next wish is made', async () => {
  const { started, maker } = workers();
  const slow = maker.make(wish(1), null);
  await vi.advanceTimersByTimeAsync(MAKE_MAX_MS);
  expect((await slow)?.error?.code).toBe('too-slow');
  expect(started[0]?.ended).toBe(true);
  const next = maker.make(wish(2), null);
  started[1]?.answer(made(0.2));
  expect((await next)?.error).toBeNull();
});

test('a module that breaks, or does not load, is an error in the answer', async () => {
  for (const cause of ['broken', 'unloaded'] as const) {
    const { started, maker } = workers();
    const made = maker.make(wish(1), null);
    started[0]?.answer({ of: 'failure', cause });
    expect((await made)?.error?.code).toBe(cause);
    expect(started[0]?.ended).toBe(true);
  }
});

test('a late message of a worker that was ended answers nothing', async () => {
  const { started, maker } = workers();
  const old = maker.make(wish(1), null);
  const young = maker.make(wish(2), null);
  await vi.advanceTimersByTimeAsync(GRACE_MS);
  started[0]?.answer(made(0.1));
  started[1]?.answer(made(0.2));
  expect([await old, (await young)?.size_m]).toEqual([null, 0.2]);
});

test('lists and files are not replaced by newer wishes', async () => {
  const { started, maker } = workers();
  const first = maker.make(wish(1), null);
  const list = maker.list();
  const second = maker.make(wish(2), null);
  started[0]?.answer(made(0.1));
  started[0]?.answer({ of: 'list', choices: { fonts: [], shapes: [] } });
  started[0]?.answer(made(0.2));
  expect((await first)?.size_m).toBe(0.1);
  expect((await list).fonts).toEqual([]);
  expect((await second)?.size_m).toBe(0.2);
});

test('the end answers all that wait', async () => {
  const { started, maker } = workers();
  const wishes = [maker.make(wish(1), null), maker.make(wish(2), null)];
  maker.end();
  expect(await Promise.all(wishes)).toEqual([null, null]);
  expect(started[0]?.ended).toBe(true);
});
