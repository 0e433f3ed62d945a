import type { Show } from './show';

/** An id that no frame of the show has: `f1`, `f2` … */
export function freeId(show: Show): string {
  const taken = new Set(show.frames.map((f) => f.id));
  for (let n = 1; ; n++) if (!taken.has(`f${n}`)) return `f${n}`;
}

/** The show in which the frame at `index` has an id, new if it had none, and the id; null: there is no such frame. */
export function withId(show: Show, index: number): [Show, string] | null {
  const frame = show.frames[index];
  if (!frame) return null;
  if (frame.id !== null) return [show, frame.id];
  const id = freeId(show);
  return [{ ...show, frames: show.frames.map((f) => (f === frame ? { ...f, id } : f)) }, id];
}

/** The show with a list as the value of a field of `rest`; an empty list takes the field out. */
export function withRest(show: Show, field: string, values: readonly unknown[]): Show {
  const others = Object.entries(show.rest).filter(([name]) => name !== field);
  const all = values.length === 0 ? others : [...others, [field, values] as const];
  return { ...show, rest: Object.fromEntries(all) };
}
