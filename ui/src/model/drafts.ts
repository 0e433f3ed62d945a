/** The part of a browser's storage that drafts use, so that tests can replace it. */
export type DraftStorage = Pick<Storage, 'getItem' | 'setItem' | 'removeItem' | 'key' | 'length'>;

/** A show with changes that the server does not have yet. */
export interface Draft {
  /** The version in the library that the draft is based on; null: none. */
  etag: string | null;
  document: unknown;
}

/** A draft of a page that was closed. */
export interface LeftDraft extends Draft {
  /** The argument of `drop`. */
  id: string;
  /** Name of the show. */
  name: string;
  /** When the draft was last written, milliseconds since 1970. */
  at_ms: number;
}

/**
 * Drafts, kept where they outlive the page. Every editor has a place of its own: two tabs that change one show never
 * write over each other's drafts.
 */
export interface Drafts {
  place(): Place;
  /** Drafts of closed pages and of this tab's earlier pages, newest first. */
  left(): LeftDraft[];
  drop(id: string): void;
}

/** The place of one editor's draft. */
export interface Place {
  id: string;
  /** Writes the draft; answers whether it could. `isLeft`: its editor closes, and any page may restore it. */
  keep(name: string, draft: Draft, isLeft?: boolean): boolean;
  drop(): void;
}

const PREFIX = 'lightbots-draft:';
/**
 * A draft of another tab that was written less than this ago, milliseconds, still belongs to that tab, unless it was
 * left. An open page writes again before: browsers let a hidden page act about once a minute.
 */
const ALIVE_MS = 80_000;
/** Period of writing an unsaved draft again, so that other pages see that its page is open, milliseconds. */
const BEAT_MS = 15_000;

/** The page that writes drafts, and its clock. */
export interface Writer {
  /** Identifies the browser tab; stays the same when the tab is loaded again. */
  tab: string;
  /** Identifies this load of the page; a new one for each load. */
  page: string;
  /** Milliseconds since 1970. */
  now_ms(): number;
}

type Written = Draft & { name: string; tab: string; at_ms: number; isLeft: boolean };

/** Drafts in the browser's storage; null keeps nothing. A full or forbidden storage throws no error. */
export function createDrafts(storage: DraftStorage | null, { tab, page, now_ms }: Writer): Drafts {
  const attempt = <T>(act: (storage: DraftStorage) => T, otherwise: T): T => {
    try {
      return storage ? act(storage) : otherwise;
    } catch {
      return otherwise;
    }
  };
  /** Ids of this page's drafts of which the last `keep` was without `isLeft`. */
  const held = new Set<string>();
  let places = 0;
  const isGone = (id: string, draft: Written) =>
    !held.has(id) && (draft.isLeft || draft.tab === tab || now_ms() - draft.at_ms > ALIVE_MS);
  const read = (s: DraftStorage, id: string): LeftDraft[] => {
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

/** Least time between two writes of a draft, milliseconds. */
const EVERY_MS = 250;

/** Writes an editor's draft soon after a change, and removes it once the server has all changes. */
export interface Keeper {
  /** Identifies the editor within the browser: the id of its draft. */
  id: string;
  /** Whether this key of the storage belongs to the editor's draft. */
  isKeptAs(key: string): boolean;
  touch(): void;
  /** Writes pending changes at once. */
  flush(): void;
  /** The show gets another name. */
  rename(name: string): void;
  /** The editor closes: another page may restore its unsaved draft. */
  leave(): void;
  /** The page came back, or the draft was removed: unsaved changes are written again. */
  hold(): void;
  /** The server has all changes. */
  saved(): void;
  /** Whether the last write of an unsaved draft failed. */
  isEndangered(): boolean;
}

/**
 * `first`: the show's name. `draft`: what to write now. `heirOf`: id of a left draft that this editor begins with; it
 * is removed once this editor's draft is written or saved.
 */
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
