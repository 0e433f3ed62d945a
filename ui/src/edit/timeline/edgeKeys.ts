import type { KeyboardEvent } from 'react';

/** Steps of the keys that move an edge, seconds: without Alt, and with Alt. */
const [STEP_S, FINE_S] = [0.5, 0.1];

/** Keys by their places on a US keyboard. Brackets are elsewhere on many, so comma and full stop do the same. */
const SIGNS: Readonly<Record<string, 1 | -1>> = {
  BracketLeft: -1,
  BracketRight: 1,
  Comma: -1,
  Period: 1,
};

/**
 * Which edge of what is chosen a key moves, and by how many seconds. `[` moves the end earlier, `]` later; with Shift
 * they move the beginning. Null: it is another key, or Ctrl or the command key is held.
 */
export function edgeKey(event: KeyboardEvent): { isEnd: boolean; by_s: number } | null {
  const sign = SIGNS[event.code];
  if (sign === undefined || event.ctrlKey || event.metaKey) return null;
  return { isEnd: !event.shiftKey, by_s: sign * (event.altKey ? FINE_S : STEP_S) };
}

/** Keeps a key from the browser and from the page, where it may mean something else. */
export function takeKey(event: KeyboardEvent) {
  event.preventDefault();
  event.stopPropagation();
}
