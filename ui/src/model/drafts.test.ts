import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { createDrafts, createKeeper, type DraftStorage } from './drafts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** A storage that throws for a value longer than `room` characters. */
function shelf(room = Infinity): DraftStorage & { things: Map<string, string> } {
  const things = new Map<string, string>();
  return {
    things,
    getItem: (key) => things.get(key) ?? null,
    setItem(key, value) {
      if (value.length > room) throw new Error('QuotaExceededError');
      things.set(key, value);
    },
    removeItem: (key) => void things.delete(key),
    key: (i) => [...things.keys()][i] ?? null,
    get length() {
      return things.size;
    },
  };
}

/** The drafts of one page of a tab, in the storage `on`, with a clock that stands. */
const drafts = (on: DraftStorage | null, tab = 'me', page = 'first', now_ms = 1000) =>
  createDrafts(on, { tab, page, now_ms: () => now_ms });
const NOTHING = { etag: null, document: {} };

test('a draft is there until the server has it', async () => {
  const common = shelf();
  const left = () => drafts(common, 'me', 'next').left();
  let n = 0;
  const keeper = createKeeper(drafts(common), 'A', () => ({ etag: '"1"', document: { n } }));
  for (n = 1; n <= 9; n++) {
    keeper.touch();
    await vi.advanceTimersByTimeAsync(100);
  }
  expect(left()).toMatchObject([{ name: 'A' }]);
  expect((left()[0]?.document as { n: number }).n).toBeGreaterThanOrEqual(7);
  keeper.touch();
  keeper.flush();
  expect(left()).toMatchObject([{ name: 'A', etag: '"1"', document: { n: 10 } }]);
  keeper.saved();
  await vi.advanceTimersByTimeAsync(1000);
  expect(left()).toEqual([]);
});

test('what has no room is said, and no shelf or junk on it is no error', () => {
  const keeper = createKeeper(drafts(shelf(5)), 'A', () => NOTHING);
  keeper.touch();
  keeper.flush();
  expect(keeper.isEndangered()).toBe(true);
  keeper.saved();
  expect(keeper.isEndangered()).toBe(false);
  expect(drafts(null).left()).toEqual([]);
  const junk = shelf();
  junk.things.set('lightbots-draft:x', '{"docu');
  junk.things.set('lightbots-draft:y', 'null');
  junk.things.set('other', '1');
  expect(drafts(junk).left()).toEqual([]);
});

test('a draft of another tab is its own until it has been left behind', () => {
  const common = shelf();
  const mine = drafts(common, 'a', 'page 1');
  const place = mine.place();
  place.keep('A', NOTHING);
  const names = (of = mine) => of.left().map((draft) => draft.name);
  expect(names()).toEqual([]);
  expect(names(drafts(common, 'a', 'page 2', 1001))).toEqual(['A']);
  expect(names(drafts(common, 'b', 'page 3', 61_000))).toEqual([]);
  expect(names(drafts(common, 'b', 'page 3', 90_000))).toEqual(['A']);
  place.keep('A', NOTHING, true);
  expect([names(), names(drafts(common, 'b', 'page 3', 1001))]).toEqual([['A'], ['A']]);
});

test('who begins with a draft that was left takes it over once it is kept again, and not before', () => {
  const common = shelf();
  drafts(common, 'a', 'page 1')
    .place()
    .keep('A', { etag: null, document: { long: 'changes' } }, true);
  const begin = (on: DraftStorage) => {
    const heir = drafts(on, 'a', 'page 2');
    const [found] = heir.left();
    const keeper = createKeeper(
      heir,
      'A',
      () => ({ etag: null, document: found?.document }),
      found?.id,
    );
    keeper.touch();
    keeper.flush();
    return heir.left().length;
  };
  expect(
    begin({
      ...common,
      setItem: () => {
        throw new Error('QuotaExceededError');
      },
    }),
  ).toBe(1);
  expect([begin(common), common.length]).toEqual([0, 1]);
});
