import { createStore, type Store } from '../base/store';

/** Whether what is on screen is safe. */
export type SaveState =
  | { name: 'saved' }
  | { name: 'waiting' }
  | { name: 'saving' }
  /** Somebody else saved meanwhile: nothing is overwritten until people choose. */
  | { name: 'conflict' }
  /** It did not work; tried again by itself. */
  | { name: 'failed'; reason: string };

export type Saved = { ok: true; etag: string } | { ok: false; conflict: boolean; reason: string };

export interface Saver {
  state: Store<SaveState>;
  /** The version in the library that this screen's show is based on. */
  etag(): string | null;
  /** Something changed: saved soon, never twice at once. */
  touch(): void;
  /** Saves now what is waiting. */
  flush(): void;
  /** Continues from another version; what is unsaved replaces it. */
  rebase(etag: string | null): void;
  /** Continues from another version that is on screen now: nothing is unsaved any more. */
  settle(etag: string | null): void;
  stop(): void;
}

/** A pause this long, or this long since the first unsaved change, saves; milliseconds. */
const PAUSE_MS = 300;
const LATEST_MS = 800;
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
