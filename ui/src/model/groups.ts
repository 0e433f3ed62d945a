import type { Frame, Pixel, Show } from './show';

/** Groups: pixels of a frame that are chosen and changed as one. Pure functions, as in `commands`. */

/** The ids with all other pixels of their groups. */
export function wholeGroups(frame: Frame | undefined, ids: Iterable<number>): Set<number> {
  const wanted = new Set(ids);
  const pixels = frame?.pixels ?? [];
  const groups = new Set(pixels.flatMap((p) => (wanted.has(p.id) && p.group ? [p.group] : [])));
  for (const p of pixels) if (p.group !== null && groups.has(p.group)) wanted.add(p.id);
  return wanted;
}

/** The names of the groups that pixels are in. */
export const groupsOf = (pixels: readonly Pixel[]): string[] => [
  ...new Set(pixels.flatMap((p) => (p.group === null ? [] : [p.group]))),
];

/** The group that all these pixels are in; null: they are in several or in none. */
export function groupOf(pixels: readonly Pixel[]): string | null {
  const group = pixels[0]?.group ?? null;
  return pixels.every((p) => p.group === group) ? group : null;
}

/** Makes one group of pixels of the frame at `index`; they leave their groups. Fewer than two ids change nothing. */
export function groupPixels(show: Show, index: number, ids: ReadonlySet<number>): Show {
  const frame = show.frames[index];
  if (!frame || ids.size < 2) return show;
  return setGroup(show, index, ids, freeName(frame));
}

/** Dissolves the groups, in the frame at `index`, that these pixels are in. */
export function ungroupPixels(show: Show, index: number, ids: Iterable<number>): Show {
  return setGroup(show, index, wholeGroups(show.frames[index], ids), null);
}

function setGroup(show: Show, index: number, ids: ReadonlySet<number>, group: string | null): Show {
  const frame = show.frames[index];
  if (!frame) return show;
  const joined = frame.pixels.map((p) =>
    ids.has(p.id) && p.group !== group ? { ...p, group } : p,
  );
  const pixels = withoutSingles(joined);
  if (pixels.every((p, i) => p === frame.pixels[i])) return show;
  return { ...show, frames: show.frames.map((f, i) => (i === index ? { ...f, pixels } : f)) };
}

/** The pixels; one that is alone in its group leaves it. */
function withoutSingles(pixels: readonly Pixel[]): Pixel[] {
  const sizes = new Map<string, number>();
  for (const { group } of pixels) if (group !== null) sizes.set(group, (sizes.get(group) ?? 0) + 1);
  return pixels.map((p) =>
    p.group !== null && sizes.get(p.group) === 1 ? { ...p, group: null } : p,
  );
}

/** A name that no group of the frame has, such as Group 2. */
function freeName(frame: Frame): string {
  const taken = new Set(groupsOf(frame.pixels));
  let number = 1;
  while (taken.has(`Group ${number}`)) number++;
  return `Group ${number}`;
}
