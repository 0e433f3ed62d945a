import type { Show } from './show';

/** A word by which no frame is named. */
export function freeId(show: Show): string {
  const taken = new Set(show.frames.map((f) => f.id));
  for (let n = 1; ; n++) if (!taken.has(`f${n}`)) return `f${n}`;
}

/** The show in which the frame at `index` has a word by which it is named, and that word; null: there is no such frame. */
export function withId(show: Show, index: number): [Show, string] | null {
  const frame = show.frames[index];
  if (!frame) return null;
  if (frame.id !== null) return [show, frame.id];
  const id = freeId(show);
  return [{ ...show, frames: show.frames.map((f) => (f === frame ? { ...f, id } : f)) }, id];
}

/** The show with another value of a field that the screen keeps as it is; an empty list takes the field out. */
export function withRest(show: Show, field: string, values: readonly unknown[]): Show {
  const others = Object.entries(show.rest).filter(([name]) => name !== field);
  const all = values.length === 0 ? others : [...others, [field, values] as const];
  return { ...show, rest: Object.fromEntries(all) };
}
