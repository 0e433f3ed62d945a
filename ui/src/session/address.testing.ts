import { vi } from 'vitest';

/** Replaces `location`, `window` and `history` by an address with `hash`; `go` changes it as a user does. */
export function stubAddress(hash: string) {
  const address = { hash };
  let listeners: (() => void)[] = [];
  const go = (to: string) => {
    address.hash = to;
    listeners.forEach((listener) => listener());
  };
  vi.stubGlobal('location', {
    get hash() {
      return address.hash;
    },
    set hash(to: string) {
      go(to);
    },
  });
  vi.stubGlobal('window', {
    addEventListener: (_: string, listener: () => void) => listeners.push(listener),
    removeEventListener: (_: string, listener: () => void) => {
      listeners = listeners.filter((each) => each !== listener);
    },
  });
  vi.stubGlobal('history', {
    replaceState: (_state: unknown, _title: string, to: string) => {
      address.hash = to;
    },
  });
  return { address, go };
}
