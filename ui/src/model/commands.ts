import { without } from './jsonFields';
import { withoutLostCues } from './cues';
import { keepLayersInFrames } from './layers';
import type { Point } from '../base/geometry';
import { mix, type Rgb } from '../base/colour';
import type { FrameSource } from './sources';
import { backRows, newFrame, newKey, type Frame, type Pixel, type Show, type Stage } from './show';

/** Changes of a show: pure functions. Those that find nothing to change mostly return the same show. */

const withFrame = (show: Show, index: number, change: (frame: Frame) => Frame): Show => {
  const frame = show.frames[index];
  if (!frame) return show;
  const next = change(frame);
  return next === frame
    ? show
    : { ...show, frames: show.frames.map((f, i) => (i === index ? next : f)) };
};

const mapPixels = (show: Show, index: number, change: (pixel: Pixel) => Pixel): Show =>
  withFrame(show, index, (frame) => {
    const pixels = frame.pixels.map(change);
    return pixels.every((p, i) => p === frame.pixels[i]) ? frame : { ...frame, pixels };
  });

/**
 * Moves pixels of the frame at `index` to the places given by id, stage metres. Moved pixels that were made from a
 * source are listed as moved by hand in that source.
 */
export function placePixels(show: Show, index: number, places: ReadonlyMap<number, Point>): Show {
  const before = show.frames[index];
  const after = mapPixels(show, index, (p) => {
    const place = places.get(p.id);
    return place && (place.x !== p.x || place.y !== p.y) ? { ...p, x: place.x, y: place.y } : p;
  });
  return before ? withFrame(after, index, (frame) => withMoved(before, frame)) : after;
}

/** The frame with those pixels listed as moved by hand in their sources that changed since `before`. */
function withMoved(before: Frame, frame: Frame): Frame {
  const left = frame.pixels.filter((p, i) => p.part !== null && p !== before.pixels[i]);
  if (left.length === 0) return frame;
  const sources = frame.sources.map((source, i) => {
    const ids = left.filter((p) => p.part?.source === i).map((p) => p.id);
    const moved = [...new Set([...source.moved, ...ids])].sort((a, b) => a - b);
    return moved.length === source.moved.length ? source : { ...source, moved };
  });
  return { ...frame, sources };
}

/** A source with its pixels, and the fields of the frame that change with it. */
export type MadeFrame = { source: FrameSource; pixels: readonly Pixel[] } & FrameFields;

/**
 * Gives the frame with `key` the source and pixels of `made[0]`, and each further one to a new frame after it. An
 * empty `made` takes the frame out. `assets`: files that the sources need, as the document lists them.
 */
export function makeFrames(
  show: Show,
  key: number,
  made: readonly MadeFrame[],
  assets: Readonly<Record<string, unknown>>,
): Show {
  const frames = show.frames.flatMap((frame) =>
    frame.key !== key
      ? [frame]
      : made.map(({ source, pixels, ...fields }, nth) => {
          const own = nth === 0 ? frame : copyFrame(frame, frame.name);
          return {
            ...own,
            ...fields,
            sources: [source],
            pixels: keepGroups(own, { source, pixels }),
          };
        }),
  );
  if (Object.keys(assets).length === 0) return { ...show, frames };
  const known = show.rest.assets as Readonly<Record<string, unknown>> | undefined;
  return { ...show, frames, rest: { ...show.rest, assets: { ...known, ...assets } } };
}

/** The made pixels. Those that the source lists as moved by hand keep the group of the frame's pixel with their id. */
function keepGroups(
  frame: Frame,
  { source, pixels }: { source: FrameSource; pixels: readonly Pixel[] },
): readonly Pixel[] {
  const groups = new Map(frame.pixels.map((p) => [p.id, p.group]));
  const kept = new Set(source.moved);
  return pixels.map((p) => (kept.has(p.id) ? { ...p, group: groups.get(p.id) ?? null } : p));
}

export const recolour = (show: Show, index: number, colors: ReadonlyMap<number, Rgb>): Show =>
  mapPixels(show, index, (p) => {
    const color = colors.get(p.id);
    return color === undefined || color === p.color ? p : { ...p, color };
  });

/** Colours by id from `from` to `to` across pixels: along x, or along y if they extend more in y. */
export function gradient(pixels: readonly Pixel[], from: Rgb, to: Rgb): Map<number, Rgb> {
  const [xs, ys] = [pixels.map((p) => p.x), pixels.map((p) => p.y)];
  const [minX, minY] = [Math.min(...xs), Math.min(...ys)];
  const [w, h] = [Math.max(...xs) - minX, Math.max(...ys) - minY];
  const share = (p: Pixel) => (w >= h ? (w > 0 ? (p.x - minX) / w : 0) : (p.y - minY) / h);
  return new Map(pixels.map((p) => [p.id, mix(from, to, share(p))]));
}

/** Binds pixel `id` to a robot in every frame, or frees it (`null`). Other pixels that were bound to it are freed. */
export function pinPixel(show: Show, id: number, robot: string | null): Show {
  const pinned = (p: Pixel): Pixel => {
    const wanted = p.id === id ? robot : p.robot === robot ? null : p.robot;
    return wanted === p.robot ? p : { ...p, robot: wanted };
  };
  return show.frames.reduce((now, _, i) => mapPixels(now, i, pinned), show);
}

/** The robot of each pinned pixel, by pixel id; if frames name several robots, the first. */
export function pinsOf(show: Show): Map<number, string> {
  const pins = new Map<number, string>();
  for (const frame of show.frames)
    for (const p of frame.pixels) if (p.robot !== null && !pins.has(p.id)) pins.set(p.id, p.robot);
  return pins;
}

/** Puts frames in after `index`. */
const insertFrames = (show: Show, index: number, frames: readonly Frame[]): Show => ({
  ...show,
  frames: [...show.frames.slice(0, index + 1), ...frames, ...show.frames.slice(index + 1)],
});

/** A copy without an absolute time and without an id, so that no layer or cue names it. */
const copyFrame = (frame: Frame, name: string): Frame => ({
  ...frame,
  key: newKey(),
  id: null,
  at_s: null,
  name,
});

/**
 * Adds a frame after the one at `after`, with the same pixels and air time, because robots stand on them. The new
 * frame's pixels belong to no source.
 */
export function addFrame(show: Show, after: number): Show {
  const before = show.frames[after];
  const pixels = (before?.pixels ?? []).map((p) => (p.part === null ? p : { ...p, part: null }));
  const frame = newFrame(`Frame ${show.frames.length + 1}`, pixels);
  return insertFrames(show, after, [{ ...frame, airTime_s: before?.airTime_s ?? 1 }]);
}

export function duplicateFrames(show: Show, indices: readonly number[]): Show {
  const sorted = [...indices].sort((a, b) => a - b);
  const copies = sorted.flatMap((i) => {
    const frame = show.frames[i];
    return frame ? [copyFrame(frame, `${frame.name} copy`.trim())] : [];
  });
  return insertFrames(show, sorted[sorted.length - 1] ?? -1, copies);
}

/** Takes frames out, and the cues that name them. If no frame would be left, nothing changes. */
export function deleteFrames(show: Show, indices: readonly number[]): Show {
  const gone = new Set(indices);
  const frames = show.frames.filter((_, i) => !gone.has(i));
  return frames.length === 0 || frames.length === show.frames.length
    ? show
    : keepLayersInFrames(show, withoutLostCues(show, { ...show, frames }));
}

/** Moves frames together, in their order, to just before the frame that is at `before` now, or to the end. */
export function moveFrames(show: Show, indices: readonly number[], before: number): Show {
  const chosen = new Set(indices);
  const at = Math.max(0, Math.min(show.frames.length, before));
  const part = (want: boolean, from: number, to: number) =>
    show.frames.slice(from, to).filter((_, i) => chosen.has(from + i) === want);
  const all = [
    ...part(false, 0, at),
    ...part(true, 0, show.frames.length),
    ...part(false, at, show.frames.length),
  ];
  if (all.every((frame, i) => frame === show.frames[i])) return show;
  return keepLayersInFrames(show, { ...show, frames: all });
}

export type FrameFields = Partial<
  Pick<Frame, 'name' | 'airTime_s' | 'at_s' | 'transition_s' | 'easing' | 'identity'>
>;

export function setFrames(show: Show, indices: readonly number[], fields: FrameFields): Show {
  const wanted = new Set(indices);
  const same = (f: Frame) => Object.entries(fields).every(([k, v]) => f[k as keyof Frame] === v);
  const frames = show.frames.map((f, i) => (wanted.has(i) && !same(f) ? { ...f, ...fields } : f));
  return frames.every((f, i) => f === show.frames[i]) ? show : { ...show, frames };
}

export const setStage = (show: Show, stage: Partial<Stage>): Show => ({
  ...show,
  stage: { ...show.stage, ...stage },
});

export const setShow = (show: Show, fields: Partial<Pick<Show, 'name' | 'identity'>>): Show => ({
  ...show,
  ...fields,
});

/** Number of pixels of the frame with the most pixels. */
export const fleetSize = (show: Show) => Math.max(0, ...show.frames.map((f) => f.pixels.length));

/** Number of spare robots of the show, which wait for others to fail; 0 where the document says no positive integer. */
export function sparesOf(show: Show): number {
  const { spares } = show.rest;
  return typeof spares === 'number' && Number.isInteger(spares) && spares > 0 ? spares : 0;
}

export function setSpares(show: Show, count: number): Show {
  const rest = without(show.rest, ['spares']);
  return { ...show, rest: count > 0 ? { ...rest, spares: count } : rest };
}

/**
 * Gives every frame `count` pixels: removes the highest ids, or adds the lowest free ids with colour `color`. New
 * pixels get places of `backRows`, first those at least 0.08 m from the frame's pixels.
 */
export function setFleetSize(show: Show, count: number, color: Rgb): Show {
  const rows = backRows(show.stage, count, color);
  const frames = show.frames.map((frame) => {
    if (frame.pixels.length >= count) return { ...frame, pixels: frame.pixels.slice(0, count) };
    const taken = new Set(frame.pixels.map((p) => p.id));
    const free = (p: Point) => frame.pixels.every((q) => Math.hypot(p.x - q.x, p.y - q.y) >= 0.08);
    const places = [...rows.filter(free), ...rows.filter((p) => !free(p))];
    const pixels = [...frame.pixels];
    for (let id = 0; pixels.length < count; id++) {
      if (taken.has(id)) continue;
      const place = places[pixels.length - frame.pixels.length] ?? { x: 0, y: 0 };
      pixels.push({ id, x: place.x, y: place.y, color, robot: null, part: null, group: null });
    }
    return { ...frame, pixels: pixels.sort((a, b) => a.id - b.id) };
  });
  return { ...show, frames };
}
