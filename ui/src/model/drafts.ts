/** What of a browser's storage is used, so that tests can stand in for it. */
export type Shelf = Pick<Storage, 'getItem' | 'setItem' | 'removeItem' | 'key' | 'length'>;

/** A show as it is on this screen and not yet on the server. */
export interface Draft {
  /** The version in the library it is based on. */
  etag: string | null;
  document: unknown;
}

/** Drafts by the names of their shows, kept where they outlive the page. */
export interface Drafts {
  /** Whether there was room for it. */
  keep(name: string, draft: Draft): boolean;
  read(name: string): Draft | null;
  drop(name: string): void;
  names(): string[];
}

const PREFIX = 'lightbots-draft:';
/** A draft of another tab that is younger is still that tab's own: it saves it itself, milliseconds. */
const ALIVE_MS = 5000;

/** Who writes drafts, and when. */
export interface Writer {
  /** Tells the tabs of a browser apart, and stays the same when one is loaded again. */
  tab: string;
  /** Milliseconds since 1970. */
  now_ms(): number;
}

type Written = Draft & { tab: string; at_ms: number };

/** Drafts on a shelf; without one nothing is kept. A full or forbidden shelf is no error. */
export function createDrafts(shelf: Shelf | null, { tab, now_ms }: Writer): Drafts {
  const attempt = <T>(act: (shelf: Shelf) => T, otherwise: T): T => {
    try {
      return shelf ? act(shelf) : otherwise;
    } catch {
      return otherwise;
    }
  };
  /** What is kept and has been left behind. */
  const left = (s: Shelf, key: string): Written | null => {
    const draft = JSON.parse(s.getItem(key) ?? 'null') as Written | null;
    if (typeof draft?.document !== 'object') return null;
    return draft.tab === tab || now_ms() - draft.at_ms > ALIVE_MS ? draft : null;
  };
  return {
    keep: (name, draft) =>
      attempt((s) => {
        s.setItem(PREFIX + name, JSON.stringify({ ...draft, tab, at_ms: now_ms() }));
        return true;
      }, false),
    read: (name) =>
      attempt((s) => {
        const draft = left(s, PREFIX + name);
        return draft && { etag: draft.etag, document: draft.document };
      }, null),
    drop: (name) => attempt((s) => s.removeItem(PREFIX + name), undefined),
    names: () =>
      attempt((s) => {
        const keys = Array.from({ length: s.length }, (_, i) => s.key(i) ?? '');
        const mine = keys.filter((k) => k.startsWith(PREFIX));
        return mine
          .filter((key) => attempt((shelf) => left(shelf, key), null))
          .map((key) => key.slice(PREFIX.length));
      }, []),
  };
}

/** Writes a draft soon after each change, and as often as this at most, milliseconds. */
const EVERY_MS = 250;

/** Keeps what is unsaved: a draft follows every change, and goes once the server has it. */
export interface Keeper {
  touch(): void;
  /** Writes now what would be written soon. */
  flush(): void;
  /** The server has everything. */
  saved(): void;
  /** Whether a change is unsaved that the shelf had no room for. */
  isEndangered(): boolean;
}

export function createKeeper(drafts: Drafts, name: string, draft: () => Draft): Keeper {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let endangered = false;
  const write = () => {
    clearTimeout(timer);
    timer = undefined;
    endangered = !drafts.keep(name, draft());
  };
  return {
    touch: () => void (timer ??= setTimeout(write, EVERY_MS)),
    flush: () => (timer === undefined ? undefined : write()),
    saved() {
      clearTimeout(timer);
      timer = undefined;
      endangered = false;
      drafts.drop(name);
    },
    isEndangered: () => endangered,
  };
}
