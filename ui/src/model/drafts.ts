/** What of a browser's storage is used, so that tests can stand in for it. */
export type Shelf = Pick<Storage, 'getItem' | 'setItem' | 'removeItem' | 'key' | 'length'>;

/** A show as it is on this screen and not yet on the server. */
export interface Draft {
  /** The version in the library it is based on. */
  etag: string | null;
  document: unknown;
}

/** A draft whose page is gone. */
export interface LeftDraft extends Draft {
  /** What `drop` takes. */
  id: string;
  /** Of which show. */
  name: string;
  /** When it was last written, milliseconds since 1970. */
  at_ms: number;
}

/**
 * Drafts, kept where they outlive the page. Every editor has a place of its own: two tabs that change one show never
 * write over each other's drafts.
 */
export interface Drafts {
  place(): Place;
  /** What pages that are gone left behind, newest first. */
  left(): LeftDraft[];
  drop(id: string): void;
}

/** Where the draft of one editor lies. */
export interface Place {
  id: string;
  /** Whether there was room for the draft of that show. `isLeft`: its page is going, others may have it. */
  keep(name: string, draft: Draft, isLeft?: boolean): boolean;
  drop(): void;
}

const PREFIX = 'lightbots-draft:';
/**
 * A draft of another tab that is younger is still that tab's own: it saves it itself, milliseconds. Browsers let a
 * hidden page do something once a minute.
 */
const ALIVE_MS = 80_000;
/** What is unsaved is written again this often, so that others see that its page lives, milliseconds. */
const BEAT_MS = 15_000;

/** Who writes drafts, and when. */
export interface Writer {
  /** Tells the tabs of a browser apart, and stays the same when one is loaded again. */
  tab: string;
  /** Tells pages apart: never the same again. */
  page: string;
  /** Milliseconds since 1970. */
  now_ms(): number;
}

type Written = Draft & { name: string; tab: string; at_ms: number; isLeft: boolean };

/** Drafts on a shelf; without one nothing is kept. A full or forbidden shelf is no error. */
export function createDrafts(shelf: Shelf | null, { tab, page, now_ms }: Writer): Drafts {
  const attempt = <T>(act: (shelf: Shelf) => T, otherwise: T): T => {
    try {
      return shelf ? act(shelf) : otherwise;
    } catch {
      return otherwise;
    }
  };
  /** Places of this page whose editor still has its draft in hand. */
  const held = new Set<string>();
  let places = 0;
  const isGone = (id: string, draft: Written) =>
    !held.has(id) && (draft.isLeft || draft.tab === tab || now_ms() - draft.at_ms > ALIVE_MS);
  const read = (s: Shelf, id: string): LeftDraft[] => {
    const draft = JSON.parse(s.getItem(PREFIX + id) ?? 'null') as Written | null;
    if (typeof draft?.document !== 'object' || !isGone(id, draft)) return [];
    const { name, etag, document, at_ms } = draft;
    return [{ id, name, etag, document, at_ms }];
  };
  const drop = (id: string) => attempt((s) => s.removeItem(PREFIX + id), undefined);
  return {
    place() {
      const id = `${page}-${++places}`;
      return {
        id,
        keep(name, draft, isLeft = false) {
          if (isLeft) held.delete(id);
          else held.add(id);
          return attempt((s) => {
            const written: Written = { ...draft, name, tab, at_ms: now_ms(), isLeft };
            s.setItem(PREFIX + id, JSON.stringify(written));
            return true;
          }, false);
        },
        drop: () => drop(id),
      };
    },
    left: () =>
      attempt((s) => {
        const keys = Array.from({ length: s.length }, (_, i) => s.key(i) ?? '');
        const ids = keys.filter((key) => key.startsWith(PREFIX));
        return ids
          .flatMap((key) => attempt((known) => read(known, key.slice(PREFIX.length)), []))
          .sort((a, b) => b.at_ms - a.at_ms);
      }, []),
    drop,
  };
}

/** Writes a draft soon after each change, and as often as this at most, milliseconds. */
const EVERY_MS = 250;

/** Keeps what is unsaved: a draft follows every change, and goes once the server has it. */
export interface Keeper {
  /** Tells editors of this page apart. */
  id: string;
  /** Whether that key of the shelf is its draft's. */
  isKeptAs(key: string): boolean;
  touch(): void;
  /** Writes now what would be written soon. */
  flush(): void;
  /** The show has another name from now on. */
  rename(name: string): void;
  /** The editor goes: its draft is for whoever comes next. */
  leave(): void;
  /** The page came back, or somebody took the draft away: what is unsaved is written again. */
  hold(): void;
  /** The server has everything. */
  saved(): void;
  /** Whether a change is unsaved that the shelf had no room for. */
  isEndangered(): boolean;
}

/** `heirOf`: a draft that was left and is what this editor begins with; it goes once it is kept here or saved. */
export function createKeeper(
  drafts: Drafts,
  first: string,
  draft: () => Draft,
  heirOf?: string,
): Keeper {
  const place = drafts.place();
  let name = first;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let beat: ReturnType<typeof setInterval> | undefined;
  let [isUnsaved, isEndangered] = [false, false];
  const write = (isLeft = false) => {
    clearTimeout(timer);
    timer = undefined;
    isEndangered = !place.keep(name, draft(), isLeft);
    if (!isEndangered && heirOf !== undefined) drafts.drop(heirOf);
  };
  const rest = () => {
    clearTimeout(timer);
    clearInterval(beat);
    timer = beat = undefined;
  };
  return {
    id: place.id,
    isKeptAs: (key) => key === PREFIX + place.id,
    touch() {
      isUnsaved = true;
      beat ??= setInterval(write, BEAT_MS);
      timer ??= setTimeout(write, EVERY_MS);
    },
    flush() {
      if (timer !== undefined) write();
    },
    rename(next) {
      name = next;
      if (isUnsaved) write();
    },
    leave() {
      if (isUnsaved) write(true);
      rest();
    },
    hold() {
      if (!isUnsaved) return;
      write();
      beat ??= setInterval(write, BEAT_MS);
    },
    saved() {
      rest();
      [isUnsaved, isEndangered] = [false, false];
      place.drop();
      if (heirOf !== undefined) drafts.drop(heirOf);
    },
    isEndangered: () => isEndangered,
  };
}
