/** Most marks that can be undone; the oldest fall off. */
const MARKS_MAX = 500;

/** A change that can be undone: the state before and after it, and its frame. */
export interface Mark<T> {
  before: T;
  after: T;
  /** Name of the change, shown with Undo. */
  label: string;
  /** Index of the frame on the stage at the change. */
  frame: number;
}

export interface History<T> {
  past: readonly Mark<T>[];
  future: readonly Mark<T>[];
}

export const noHistory = <T>(): History<T> => ({ past: [], future: [] });

export const remember = <T>(history: History<T>, mark: Mark<T>): History<T> => ({
  past: [...history.past.slice(-MARKS_MAX + 1), mark],
  future: [],
});

export function stepBack<T>(history: History<T>): [History<T>, Mark<T>] | null {
  const mark = history.past[history.past.length - 1];
  if (!mark) return null;
  return [{ past: history.past.slice(0, -1), future: [...history.future, mark] }, mark];
}

export function stepForth<T>(history: History<T>): [History<T>, Mark<T>] | null {
  const mark = history.future[history.future.length - 1];
  if (!mark) return null;
  return [{ past: [...history.past, mark], future: history.future.slice(0, -1) }, mark];
}

/**
 * The history moved to the point after its first `changes` marks. Also a mark next to that point, and which of its
 * states, `before` or `after`, is the state at the point. Null: the history is at that point already.
 */
export function stepTo<T>(
  history: History<T>,
  changes: number,
): [History<T>, Mark<T>, 'before' | 'after'] | null {
  const marks = [...history.past, ...[...history.future].reverse()];
  const [from, to] = [history.past.length, Math.max(0, Math.min(marks.length, changes))];
  const mark = marks[to < from ? to : to - 1];
  if (from === to || !mark) return null;
  const moved = { past: marks.slice(0, to), future: marks.slice(to).reverse() };
  return [moved, mark, to < from ? 'before' : 'after'];
}
