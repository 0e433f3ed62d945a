import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import {
  createDrafts,
  createKeeper,
  type Drafts,
  type LeftDraft,
  type DraftStorage,
} from './drafts';
import { createSaver, type Saved } from './saver';

/*
 * Tabs of one browser change one show, on a server that comes and goes. Every change adds a word; a document is a list
 * of words. Whatever happens, only words that an act throws away may be lost.
 */

beforeEach(() => void vi.useFakeTimers({ now: 0 }));
afterEach(() => void vi.useRealTimers());

/** Number of random courses that are tried. */
const SEEDS = 40;
/** Number of random acts in each course. */
const ACTS = 60;
const TABS = ['left', 'middle', 'right'];
/** A change is in the storage at the latest this time after it was made, milliseconds. */
const WRITTEN_MS = 250;

type Words = Set<string>;
const wordsOf = (draft: Pick<LeftDraft, 'document'>) => draft.document as string[];

/** A function that gives pseudo-random numbers from 0 to `sides` - 1 (Park and Miller's generator). */
function createDice(seed: number) {
  let state = seed * 7919 + 1;
  return (sides: number) => (state = (state * 48_271) % 2_147_483_647) % sides;
}

/** A page of a tab, with the show in its editor. */
interface Page {
  tab: string;
  isGone: boolean;
  drafts: Drafts;
  words: Words;
  /** When words were added on this page, milliseconds, by word. */
  added_ms: Map<string, number>;
  saver: ReturnType<typeof createSaver>;
  keeper: ReturnType<typeof createKeeper>;
}

class World {
  pages = new Map<string, Page>();
  things = new Map<string, string>();
  thrownAway: Words = new Set();
  isServerUp = true;
  version = 1;
  /** The words that the server has now; `ever`: all that it ever had. */
  words: Words = new Set();
  ever: Words = new Set();
  made = 0;
  readonly dice: (sides: number) => number;

  constructor(seed: number) {
    this.dice = createDice(seed);
  }

  /** Opens the show in a new page of a tab; the tab may have had a page before. */
  open(tab: string) {
    const page = { tab, isGone: false, added_ms: new Map() } as Page;
    const writer = { tab, page: `page${++this.made}`, now_ms: () => Date.now() };
    page.drafts = createDrafts(this.shelfOf(page), writer);
    this.edit(page, page.drafts.left()[0]);
    this.pages.set(tab, page);
  }

  /** Begins an editor in a page, with a draft that was left or with what the server has. */
  edit(page: Page, left?: LeftDraft) {
    const words = (page.words = new Set(left ? wordsOf(left) : this.words));
    const saver = createSaver(left ? left.etag : this.etag(), (etag) => this.put(words, etag));
    const draft = () => ({ etag: saver.etag(), document: [...words] });
    const keeper = createKeeper(page.drafts, 'show', draft, left?.id);
    saver.state.subscribe(() => {
      if (saver.state.get().name === 'saved') keeper.saved();
    });
    Object.assign(page, { saver, keeper });
    if (!left) return;
    saver.touch();
    keeper.touch();
    keeper.flush();
  }

  close(page: Page) {
    page.keeper.leave();
    this.end(page);
  }

  /** Ends a page: it neither saves nor writes any more. */
  end(page: Page) {
    page.saver.stop();
    page.isGone = true;
    this.pages.delete(page.tab);
  }

  etag = () => `"${this.version}"`;

  accept(words: Iterable<string>) {
    this.version++;
    this.words = new Set(words);
    for (const word of this.words) this.ever.add(word);
  }

  async put(words: Words, etag: string | null): Promise<Saved> {
    const sent = [...words];
    await new Promise((resolve) => setTimeout(resolve, this.dice(400)));
    if (!this.isServerUp) return { ok: false, conflict: false, reason: 'away' };
    if (etag !== this.etag()) return { ok: false, conflict: true, reason: '412' };
    this.accept(sent);
    return { ok: true, etag: this.etag() };
  }

  /** The storage of all pages, as `page` uses it; other pages are told when it removes their draft. */
  shelfOf(page: Page): DraftStorage {
    const { things, pages } = this;
    return {
      getItem: (key) => things.get(key) ?? null,
      setItem: (key, value) => void (page.isGone || things.set(key, value)),
      removeItem(key) {
        if (page.isGone || !things.delete(key)) return;
        for (const other of pages.values())
          if (other !== page && other.keeper.isKeptAs(key)) other.keeper.hold();
      },
      key: (i) => [...things.keys()][i] ?? null,
      get length() {
        return things.size;
      },
    };
  }

  /** All words that the server ever had, that a page shows, that a later page finds as left drafts, or thrown away. */
  safe(): Words {
    const writer = { tab: 'new', page: 'new', now_ms: () => Date.now() + 200_000 };
    const absent = { isGone: false } as Page;
    const left = createDrafts(this.shelfOf(absent), writer).left().flatMap(wordsOf);
    const shown = [...this.pages.values()].flatMap((page) => [...page.words]);
    return new Set([...this.ever, ...left, ...shown, ...this.thrownAway]);
  }
}

/** What people, browsers and networks do. */
const acts: ((world: World, page: Page) => void)[] = [
  function change(world, page) {
    const word = `word${++world.made}`;
    page.words.add(word);
    page.added_ms.set(word, Date.now());
    page.saver.touch();
    page.keeper.touch();
  },
  function serverComesOrGoes(world) {
    world.isServerUp = !world.isServerUp;
  },
  function reload(world, page) {
    world.close(page);
    world.open(page.tab);
  },
  function closeTab(world, page) {
    world.close(page);
  },
  function crash(world, page) {
    for (const [word, at_ms] of page.added_ms)
      if (Date.now() - at_ms <= WRITTEN_MS) world.thrownAway.add(word);
    world.end(page);
  },
  function putBack(world, page) {
    const [left] = page.drafts.left();
    if (!left) return;
    page.saver.flush();
    page.keeper.leave();
    world.edit(page, left);
  },
  function dropWhatWasLeft(world, page) {
    const [left] = page.drafts.left();
    if (!left) return;
    for (const word of wordsOf(left)) world.thrownAway.add(word);
    page.drafts.drop(left.id);
  },
  function takeTheirs(world, page) {
    if (page.saver.state.get().name !== 'conflict') return;
    for (const word of page.words) world.thrownAway.add(word);
    page.words.clear();
    for (const word of world.words) page.words.add(word);
    page.saver.settle(world.etag());
  },
  function keepMine(world, page) {
    if (page.saver.state.get().name === 'conflict') page.saver.rebase(world.etag());
  },
  function keepBoth(world, page) {
    if (page.saver.state.get().name !== 'conflict') return;
    for (const word of page.words) world.ever.add(word);
    page.saver.settle(page.saver.etag());
  },
];
const [change] = acts;

test.each(Array.from({ length: SEEDS }, (_, seed) => seed))(
  'whatever tabs, people and the server do, no change is lost (seed %i)',
  async (seed) => {
    const world = new World(seed);
    const changes: Words = new Set();
    for (let i = 0; i < ACTS; i++) {
      const tab = TABS[world.dice(TABS.length)] ?? '';
      const page = world.pages.get(tab);
      if (!page) world.open(tab);
      else {
        // At least half of the acts are changes: without them there is nothing to lose.
        const act = world.dice(2) === 0 ? change : acts[world.dice(acts.length)];
        act?.(world, page);
        for (const word of page.words) changes.add(word);
      }
      await vi.advanceTimersByTimeAsync(world.dice(900));
      const lost = [...changes].filter((word) => !world.safe().has(word));
      expect(lost, `after act ${i}`).toEqual([]);
    }
    for (const page of [...world.pages.values()]) world.close(page);
    expect([...changes].filter((word) => !world.safe().has(word))).toEqual([]);
    expect(changes.size).toBeGreaterThan(5);
  },
);
