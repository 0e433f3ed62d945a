import { createStore, type Store } from '../base/store';

/** Whether the server has the changes of this screen. */
export type SaveState =
  | { name: 'saved' }
  | { name: 'waiting' }
  | { name: 'saving' }
  /** Another screen saved a newer version: nothing is overwritten until the user chooses. */
  | { name: 'conflict' }
  /** Saving failed; the next attempt is automatic. */
  | { name: 'failed'; reason: string };

export type Saved = { ok: true; etag: string } | { ok: false; conflict: boolean; reason: string };

export interface Saver {
  state: Store<SaveState>;
  /** The version in the library that this screen's show is based on. */
  etag(): string | null;
  /** The show changed: saves soon, one save at a time; during a conflict not before `rebase`. */
  touch(): void;
  /** Saves pending changes at once, unless a save is under way or there is a conflict. */
  flush(): void;
  /** Continues from another version; unsaved changes are then saved over it. */
  rebase(etag: string | null): void;
  /** Continues from another version that the screen shows: no change is unsaved. */
  settle(etag: string | null): void;
  stop(): void;
}

/** Time without a change after which the show is saved, milliseconds. */
const PAUSE_MS = 300;
/** Longest time between the first unsaved change and the start of a save, milliseconds, if none is under way. */
const LATEST_MS = 800;
/** Time between a failed save and the next attempt, milliseconds. */
const AGAIN_MS = 2000;

export function createSaver(
  first: string | null,
  put: (etag: string | null) => Promise<Saved>,
): Saver {
  const state = createStore<SaveState>({ name: 'saved' });
  let [etag, busy, dirty, stopped] = [first, false, false, false];
  let pause: ReturnType<typeof setTimeout> | undefined;
  let latest: ReturnType<typeof setTimeout> | undefined;

  const clear = () => {
    clearTimeout(pause);
    clearTimeout(latest);
    latest = undefined;
  };
  const save = async () => {
    clear();
    if (busy || !dirty || stopped) return;
    [busy, dirty] = [true, false];
    state.set({ name: 'saving' });
    const saved = await put(etag);
    busy = false;
    if (stopped) return;
    if (saved.ok) {
      etag = saved.etag;
      if (dirty) later(PAUSE_MS);
      else state.set({ name: 'saved' });
      return;
    }
    dirty = true;
    if (saved.conflict) state.set({ name: 'conflict' });
    else {
      state.set({ name: 'failed', reason: saved.reason });
      pause = setTimeout(() => void save(), AGAIN_MS);
    }
  };
  const later = (ms: number) => {
    state.set({ name: 'waiting' });
    clearTimeout(pause);
    pause = setTimeout(() => void save(), ms);
    latest ??= setTimeout(() => void save(), LATEST_MS);
  };
  return {
    state,
    etag: () => etag,
    touch() {
      dirty = true;
      if (!busy && state.get().name !== 'conflict') later(PAUSE_MS);
    },
    flush() {
      if (state.get().name !== 'conflict') void save();
    },
    rebase(next) {
      etag = next;
      if (dirty && !busy) later(0);
      else if (!busy) state.set({ name: 'saved' });
    },
    settle(next) {
      clear();
      [etag, dirty] = [next, false];
      state.set({ name: 'saved' });
    },
    stop() {
      stopped = true;
      clear();
    },
  };
}
