import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { createDrafts, createKeeper, type Shelf } from './drafts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

/** A shelf with room for so many characters in one thing. */
function shelf(room = Infinity): Shelf & { things: Map<string, string> } {
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

const ME = { tab: 'me', now_ms: () => 1000 };

test('a draft is there until the server has it', async () => {
  const drafts = createDrafts(shelf(), ME);
  let n = 0;
  const keeper = createKeeper(drafts, 'A', () => ({ etag: '"1"', document: { n } }));
  for (n = 1; n <= 9; n++) {
    keeper.touch();
    await vi.advanceTimersByTimeAsync(100);
  }
  expect(drafts.names()).toEqual(['A']);
  const kept = drafts.read('A')?.document as { n: number };
  expect(kept.n).toBeGreaterThanOrEqual(7);
  keeper.touch();
  keeper.flush();
  expect(drafts.read('A')).toEqual({ etag: '"1"', document: { n: 10 } });
  keeper.saved();
  await vi.advanceTimersByTimeAsync(1000);
  expect(drafts.names()).toEqual([]);
});

test('what has no room is said, and no shelf or junk on it is no error', () => {
  const keeper = createKeeper(createDrafts(shelf(5), ME), 'A', () => ({
    etag: null,
    document: {},
  }));
  keeper.touch();
  keeper.flush();
  expect(keeper.isEndangered()).toBe(true);
  keeper.saved();
  expect(keeper.isEndangered()).toBe(false);
  expect(createDrafts(null, ME).names()).toEqual([]);
  const junk = shelf();
  junk.things.set('lightbots-draft:x', '{"docu');
  junk.things.set('other', '1');
  expect(createDrafts(junk, ME).names()).toEqual([]);
  expect(createDrafts(junk, ME).read('x')).toBeNull();
});

test('a draft of another tab is its own until it has been left behind', () => {
  const common = shelf();
  const at = (tab: string, now_ms: number) => createDrafts(common, { tab, now_ms: () => now_ms });
  at('a', 1000).keep('A', { etag: null, document: {} });
  expect([at('a', 1001).names(), at('b', 3000).names()]).toEqual([['A'], []]);
  expect(at('b', 3000).read('A')).toBeNull();
  expect(at('b', 9000).read('A')).toEqual({ etag: null, document: {} });
});
