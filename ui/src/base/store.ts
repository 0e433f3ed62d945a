import { useEffect, useState, useSyncExternalStore } from 'react';

/** A value that can be read and followed, but not changed, through this interface. */
export interface Readable<T> {
  get(): T;
  /** Calls the listener after every change; returns a function that ends this. */
  subscribe(listener: () => void): () => void;
}

/** A value that calls its listeners after every change. It does not know React; `useStore` connects the two. */
export interface Store<T> extends Readable<T> {
  /** Replaces the value; listeners run only when it is another one (`Object.is`). */
  set(next: T): void;
  update(change: (now: T) => T): void;
}

export function createStore<T>(initial: T): Store<T> {
  let value = initial;
  const listeners = new Set<() => void>();
  const set = (next: T) => {
    if (Object.is(next, value)) return;
    value = next;
    for (const listener of [...listeners]) listener();
  };
  return {
    get: () => value,
    set,
    update: (change) => set(change(value)),
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}

/** Renders again when `select` gives another value. `select` must return the same object for the same state. */
export function useStore<T, S = T>(
  store: Readable<T>,
  select: (value: T) => S = (v) => v as never,
): S {
  const look = () => select(store.get());
  return useSyncExternalStore(store.subscribe, look, look);
}

/** The value, up to `every_ms` milliseconds late: for values that change a thousand times at once. */
export function useStorePaced<T>(store: Readable<T>, every_ms: number): T {
  const [value, setValue] = useState(store.get);
  useEffect(() => {
    let timer: ReturnType<typeof setTimeout> | undefined;
    const look = () => {
      timer = undefined;
      setValue(() => store.get());
    };
    look();
    const unsubscribe = store.subscribe(() => {
      timer ??= setTimeout(look, every_ms);
    });
    return () => {
      unsubscribe();
      clearTimeout(timer);
    };
  }, [store, every_ms]);
  return value;
}
