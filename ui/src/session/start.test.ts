import { expect, test, vi } from 'vitest';
import { createStore } from '../base/store';
import type { Session } from './session';
import { createEditor } from '../model/editor';
import { readShow } from '../model/json';
import { createSaver, type Saved } from '../model/saver';
import type { ShowEntry } from '../api/types.gen';
import { stubAddress } from './address.testing';
import { copyText, followCopy } from './copies';
import { followPlan, whenPlanned } from './start';
import { createLive, receive } from './live';
import { notify } from './notices';
import { planOf } from './plan.testing';

vi.mock('./notices', () => ({ notify: vi.fn() }));

function setup() {
  const live = createLive();
  const session = {
    live,
    waiting: createStore<ReturnType<Session['waiting']['get']>>(null),
    editing: createStore<ReturnType<Session['editing']['get']>>(null),
  };
  const stop = followPlan(session);
  live.link.set('open');
  const open = (revision: number, name = 'A') =>
    receive(live, { type: 'show', revision, name, etag: '"1"', read_only: null, document: {} });
  const plan = (revision: number, planning = false) =>
    receive(live, { type: 'plan', ...planOf(revision, planning) });
  const act = vi.fn();
  open(1);
  return { ...session, open, plan, stop, act, pending: () => whenPlanned(session, act) };
}

test('what is planned is played at once', () => {
  const { plan, pending, act } = setup();
  plan(1);
  pending();
  expect(act).toHaveBeenCalledTimes(1);
});

test('while the plan is being made it waits, and does it once', () => {
  const { plan, open, pending, act, waiting } = setup();
  plan(1, true);
  pending();
  // Changed again meanwhile: a plan of what was is none of what is.
  open(2);
  plan(1);
  expect([act.mock.calls.length, waiting.get() === null]).toEqual([0, false]);
  plan(2);
  plan(2);
  expect([act.mock.calls.length, waiting.get()]).toEqual([1, null]);
});

test('a plan of the show as it was is waited out too', () => {
  const { plan, open, pending, act } = setup();
  plan(1);
  open(2);
  pending();
  expect(act).not.toHaveBeenCalled();
  plan(2);
  expect(act).toHaveBeenCalledTimes(1);
});

test('what was edited a moment ago is saved and planned before it is played', async () => {
  const { plan, editing, live, pending, act } = setup();
  let answer: (saved: Saved) => void = () => {};
  const saver = createSaver('"1"', () => new Promise((resolve) => (answer = resolve)));
  editing.set({ name: 'A', editor: createEditor(readShow({}), 0), saver });
  plan(1);
  saver.touch();
  pending();
  saver.flush();
  answer({ ok: true, etag: '"2"' });
  await vi.waitFor(() => expect(saver.state.get().name).toBe('saved'));
  expect(act, 'the server has not said so yet').not.toHaveBeenCalled();
  receive(live, {
    type: 'show',
    revision: 2,
    name: 'A',
    etag: '"2"',
    read_only: null,
    document: {},
  });
  expect(act, 'there is no plan of it yet').not.toHaveBeenCalled();
  plan(2);
  expect(act).toHaveBeenCalledTimes(1);
});

test.each<[string, (world: ReturnType<typeof setup>) => void, string[]]>([
  ['another show is opened', ({ open }) => open(2, 'B'), ['Another show was opened']],
  ['the link breaks', ({ live }) => live.link.set('lost'), ['The connection to LightBots broke']],
  ['the page is left', ({ stop }) => stop(), []],
  ['it is given up', ({ waiting }) => waiting.set(null), []],
])('nothing plays by itself after %s', (_, happen, said) => {
  vi.mocked(notify).mockClear();
  const world = setup();
  world.plan(1, true);
  world.pending();
  happen(world);
  world.live.link.set('open');
  world.plan(2);
  expect(world.act).not.toHaveBeenCalled();
  const words = said.map(
    (why) => `${why} before the show was planned. Nothing was begun: press again.`,
  );
  expect(vi.mocked(notify).mock.calls).toEqual(words.map((line) => ['kept', line]));
});

test('what waits for an example goes on with the copy that its save made', () => {
  stubAddress('#/live');
  const world = setup();
  const { plan, pending, act, editing, live } = world;
  const saver = createSaver('"1"', () => Promise.resolve({ ok: true, etag: '"2"' }));
  const edited = { name: 'A', editor: createEditor(readShow({}), 0), saver };
  editing.set(edited);
  plan(1, true);
  pending();
  const asked = vi.fn(() => Promise.resolve({ id: 1, ok: true, error: null, choice: null }));
  saver.settle('"2"');
  followCopy({ ...world, ask: asked }, 'A', { name: 'A 2', copy_of: 'example' } as ShowEntry);
  expect(asked).toHaveBeenCalledWith({ do: 'open', name: 'A 2' });
  plan(1);
  expect(act, 'the plan of the example is none of what was edited').not.toHaveBeenCalled();
  edited.name = 'A 2';
  receive(live, {
    type: 'show',
    revision: 2,
    name: 'A 2',
    etag: '"2"',
    read_only: null,
    document: {},
  });
  plan(2);
  expect(act).toHaveBeenCalledTimes(1);
});

test('a copy is told in plain words', () => {
  expect(copyText({ name: 'heart 2', copy_of: 'example' })).toBe(
    'Examples are read-only. Saved as "heart 2".',
  );
});
