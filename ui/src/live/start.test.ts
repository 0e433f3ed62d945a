import { expect, test, vi } from 'vitest';
import { createStore } from '../base/store';
import type { Session } from '../shell/session';
import { followPlan, whenPlanned } from './start';
import { createLive, hear } from './store';

const PLAN = {
  ok: true,
  duration_s: 1,
  lower_bound_s: 1,
  closest_m: 0.1,
  plan_ms: 1,
  issues: [],
  transitions: [],
};

function setup() {
  const live = createLive();
  const session = { live, waiting: createStore<ReturnType<Session['waiting']['get']>>(null) };
  const stop = followPlan(session);
  live.link.set('open');
  const open = (revision: number, name = 'A') =>
    hear(live, { type: 'show', revision, name, etag: '"1"', document: {} });
  const plan = (revision: number, planning = false) =>
    hear(live, { type: 'plan', ...PLAN, revision, planning });
  const act = vi.fn();
  open(1);
  return { ...session, open, plan, stop, act, wish: () => whenPlanned(session, act) };
}

test('what is planned is played at once', () => {
  const { plan, wish, act } = setup();
  plan(1);
  wish();
  expect(act).toHaveBeenCalledTimes(1);
});

test('while the plan is being made it waits, and does it once', () => {
  const { plan, open, wish, act, waiting } = setup();
  plan(1, true);
  wish();
  // Changed again meanwhile: a plan of what was is none of what is.
  open(2);
  plan(1);
  expect([act.mock.calls.length, waiting.get() === null]).toEqual([0, false]);
  plan(2);
  plan(2);
  expect([act.mock.calls.length, waiting.get()]).toEqual([1, null]);
});

test('a plan of the show as it was is waited out too', () => {
  const { plan, open, wish, act } = setup();
  plan(1);
  open(2);
  wish();
  expect(act).not.toHaveBeenCalled();
  plan(2);
  expect(act).toHaveBeenCalledTimes(1);
});

test.each<[string, (world: ReturnType<typeof setup>) => void]>([
  ['another show is opened', ({ open }) => open(2, 'B')],
  ['the link breaks', ({ live }) => live.link.set('lost')],
  ['the page is left', ({ stop }) => stop()],
  ['it is given up', ({ waiting }) => waiting.set(null)],
])('nothing plays by itself after %s', (_, happen) => {
  const world = setup();
  world.plan(1, true);
  world.wish();
  happen(world);
  world.live.link.set('open');
  world.plan(2);
  expect(world.act).not.toHaveBeenCalled();
});
