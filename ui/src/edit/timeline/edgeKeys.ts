import type { KeyboardEvent } from 'react';

/** Steps of the keys that move an edge: alone, and with Alt, seconds. */
const [STEP_S, FINE_S] = [0.5, 0.1];

/** Keys by their places: brackets are elsewhere on many keyboards, so comma and full stop do the same. */
const SIGNS: Readonly<Record<string, 1 | -1>> = {
  BracketLeft: -1,
  BracketRight: 1,
  Comma: -1,
  Period: 1,
};

/** What a key does to the edges of what is chosen: `[` and `]` move the end, with Shift the beginning; null: nothing. */
export function edgeKey(event: KeyboardEvent): { isEnd: boolean; by_s: number } | null {
  const sign = SIGNS[event.code];
  if (sign === undefined || event.ctrlKey || event.metaKey) return null;
  return { isEnd: !event.shiftKey, by_s: sign * (event.altKey ? FINE_S : STEP_S) };
}

/** Keeps a key from the stage, where it means something else. */
export function takeKey(event: KeyboardEvent) {
  event.preventDefault();
  event.stopPropagation();
}
