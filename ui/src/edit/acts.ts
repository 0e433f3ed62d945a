import { type Point, boxOf, centreOf, inBox, scaleAbout } from '../base/geometry';
import type { Rgb } from '../base/colour';
import * as arrange from '../model/arrange';
import * as cues from '../model/cues';
import * as commands from '../model/commands';
import * as groups from '../model/groups';
import { tooClose_m, type Pixel, type Show, type Stage } from '../model/show';
import { keepColour, type Editing } from './editing';

/** Distance of pixels, centre to centre, that makes planning easy, metres; `spread` aims at it. */
const easyGap_m = (stage: Stage) => Math.max(0.08, tooClose_m(stage) + 0.016);

/** Room that `keepOnFloor` leaves between a robot's rim and the edge of the floor, metres. */
const FLOOR_EDGE_M = 0.01;

/** Pixels that an action changes: the selection, or all pixels when nothing is selected. */
function subject(editing: Editing): readonly Pixel[] {
  const chosen = editing.editor.chosenPixels();
  return chosen.length > 0 ? chosen : (editing.editor.current()?.pixels ?? []);
}

function place(editing: Editing, label: string, change: (places: Point[], show: Show) => Point[]) {
  const pixels = subject(editing);
  editing.editor.change(label, (show, s) => {
    const places = change(
      pixels.map(({ x, y }) => ({ x, y })),
      show,
    );
    return commands.placePixels(
      show,
      s.frame,
      new Map(pixels.map((p, i) => [p.id, places[i] ?? p])),
    );
  });
}

export const align = (e: Editing, edge: arrange.Edge) =>
  place(e, 'Align', (p) => arrange.align(p, edge));
export const distribute = (e: Editing, axis: 'x' | 'y') =>
  place(e, 'Distribute', (p) => arrange.distribute(p, axis));
export const mirror = (e: Editing, axis: 'x' | 'y') =>
  place(e, 'Mirror', (p) => arrange.mirror(p, axis));
export const spread = (e: Editing) =>
  place(e, 'Spread apart', (p, show) =>
    keepOnFloor(arrange.spread(p, easyGap_m(show.stage)), show.stage),
  );

/** Shifts all positions alike so that they lie on the floor. Along an axis where they do not fit, centres them. */
function keepOnFloor(places: Point[], stage: Stage): Point[] {
  const margin = stage.radius_m + FLOOR_EDGE_M;
  const floor = {
    minX: -stage.width_m / 2 + margin,
    minY: -stage.depth_m / 2 + margin,
    maxX: stage.width_m / 2 - margin,
    maxY: stage.depth_m / 2 - margin,
  };
  if (places.every((p) => inBox(p, floor))) return places;
  const box = boxOf(places);
  const shift = (low: number, high: number, from: number, to: number) =>
    high - low > to - from
      ? (from + to) / 2 - (low + high) / 2
      : Math.max(0, from - low) + Math.min(0, to - high);
  const dx = shift(box.minX, box.maxX, floor.minX, floor.maxX);
  const dy = shift(box.minY, box.maxY, floor.minY, floor.maxY);
  return places.map((p) => ({ x: p.x + dx, y: p.y + dy }));
}

/** Scales the pixels of the frame down, if they need it, and shifts them onto the floor. */
export function fitToFloor(e: Editing) {
  e.editor.change('Fit to floor', (show, s) => {
    const pixels = show.frames[s.frame]?.pixels ?? [];
    const places = keepOnFloor(withinFloor(pixels, show.stage), show.stage);
    const placed = pixels.map((p, i) => [p.id, places[i] ?? p] as const);
    return commands.placePixels(show, s.frame, new Map(placed));
  });
}

/** The places scaled down about their middle, if needed, so that their robots fit on the floor. */
function withinFloor(places: readonly Point[], stage: Stage): Point[] {
  const box = boxOf(places);
  const room = (side_m: number) => Math.max(0, side_m - 2 * (stage.radius_m + FLOOR_EDGE_M));
  const share = (side_m: number, extent_m: number) => (extent_m > 0 ? room(side_m) / extent_m : 1);
  const k = Math.min(
    1,
    share(stage.width_m, box.maxX - box.minX),
    share(stage.depth_m, box.maxY - box.minY),
  );
  return places.map((p) => scaleAbout(p, centreOf(box), k, k));
}

export const nudge = (e: Editing, dx: number, dy: number) => {
  if (e.editor.chosenPixels().length === 0) return;
  place(e, 'Nudge', (places) => places.map((p) => ({ x: p.x + dx, y: p.y + dy })));
};

/** Moves the centre of the selection, or of all pixels if nothing is selected, to a coordinate, metres. */
export const moveTo = (e: Editing, axis: 'x' | 'y', value: number) =>
  place(e, 'Place', (places) => {
    const by = value - centreOf(boxOf(places))[axis];
    return places.map((p) => ({ ...p, [axis]: p[axis] + by }));
  });

/** Colours the selection, or all pixels, in the chosen frames; the colour becomes the current one. */
export function paint(e: Editing, color: Rgb) {
  keepColour(e, color);
  recolour(e, 'Colour', (pixels) => new Map(pixels.map((p) => [p.id, color])));
}

/** Makes a colour the current one, and unless the fill tool is chosen also paints with it. */
export const chooseColour = (e: Editing, color: Rgb) =>
  e.tool.get() === 'fill' ? keepColour(e, color) : paint(e, color);

export function paintGradient(e: Editing, from: Rgb, to: Rgb) {
  recolour(e, 'Gradient', (pixels) => commands.gradient(pixels, from, to));
}

/** Colours the selection in every chosen frame, or all their pixels if the frame on the stage has no selected one. */
function recolour(
  e: Editing,
  label: string,
  colorsOf: (pixels: readonly Pixel[]) => Map<number, Rgb>,
) {
  const { selection } = e.editor.state.get();
  const isAll = e.editor.chosenPixels().length === 0;
  const change = (show: Show, index: number) => {
    const pixels = show.frames[index]?.pixels ?? [];
    const meant = isAll ? pixels : pixels.filter((p) => selection.has(p.id));
    return commands.recolour(show, index, colorsOf(meant));
  };
  e.editor.change(label, (show) => chosenFrames(e).reduce(change, show));
}

/** Lets the show wait for GO after each chosen frame, at a cue of that name; null: it goes on by itself. */
export const setCue = (e: Editing, name: string | null) =>
  e.editor.change('Cue', (show) => cues.setCue(show, chosenFrames(e), name));

/** Lets the cue of the frame at `index` repeat from frame `from` until GO; null: it only waits. */
export const setLoop = (e: Editing, index: number, from: number | null) =>
  e.editor.change('Cue', (show) => cues.setLoop(show, index, from));

/** Makes the selection one group. */
export const group = (e: Editing) =>
  e.editor.change('Group', (show, s) => groups.groupPixels(show, s.frame, s.selection));

/** Dissolves the groups of the selection. */
export const ungroup = (e: Editing) =>
  e.editor.change('Ungroup', (show, s) => groups.ungroupPixels(show, s.frame, s.selection));

const chosenFrames = (e: Editing) => [...e.editor.state.get().frames].sort((a, b) => a - b);

export function addFrame(e: Editing) {
  e.editor.change('Add frame', (show, s) => commands.addFrame(show, s.frame));
  e.editor.goToFrame(e.editor.state.get().frame + 1);
}

export function duplicateFrames(e: Editing) {
  const frames = chosenFrames(e);
  e.editor.change('Duplicate frame', (show) => commands.duplicateFrames(show, frames));
  const first = (frames[frames.length - 1] ?? 0) + 1;
  e.editor.chooseFrames(frames.map((_, i) => first + i));
}

export function deleteFrames(e: Editing) {
  const frames = chosenFrames(e);
  e.editor.change('Delete frame', (show) => commands.deleteFrames(show, frames));
  e.editor.goToFrame(Math.min(frames[0] ?? 0, e.editor.state.get().show.frames.length - 1));
}

/** Moves frames together, to just before the frame that is at `before` now, or to the end, and chooses them. */
export function moveFrames(e: Editing, indices: readonly number[], before: number) {
  const keys = indices.map((i) => e.editor.state.get().show.frames[i]?.key);
  e.editor.change('Move frame', (show) => commands.moveFrames(show, indices, before));
  const { frames } = e.editor.state.get().show;
  e.editor.chooseFrames(frames.flatMap((frame, i) => (keys.includes(frame.key) ? [i] : [])));
}

/** Moves the chosen frames together, one place before the first of them or behind the last of them. */
export function shiftFrames(e: Editing, by: -1 | 1) {
  const frames = chosenFrames(e);
  const [first, last] = [frames[0] ?? 0, frames[frames.length - 1] ?? 0];
  moveFrames(e, frames, by < 0 ? first - 1 : last + 2);
}

/**
 * Moves the dragged frame, or all chosen frames if it is one of them, next to the frame at `to`. They go behind it if
 * it is later than the dragged frame, else before it. If it is one of the moved frames, nothing moves.
 */
export function dropFrames(e: Editing, dragged: number, to: number) {
  const { frames } = e.editor.state.get();
  const moved = frames.has(dragged) ? chosenFrames(e) : [dragged];
  if (!moved.includes(to)) moveFrames(e, moved, dragged < to ? to + 1 : to);
}

export const renameFrame = (e: Editing, index: number, name: string) =>
  e.editor.change('Rename frame', (show) => commands.setFrames(show, [index], { name }));

export const setFrames = (e: Editing, fields: commands.FrameFields) =>
  e.editor.change('Frame', (show) => commands.setFrames(show, chosenFrames(e), fields));

/** Chooses all pixels of the frame that have the colour of any chosen pixel. */
export function selectSameColour(e: Editing) {
  const colors = new Set(e.editor.chosenPixels().map((p) => p.color));
  const pixels = e.editor.current()?.pixels ?? [];
  e.editor.select(pixels.filter((p) => colors.has(p.color)).map((p) => p.id));
}

export function selectAll(e: Editing) {
  e.editor.select(e.editor.current()?.pixels.map((p) => p.id) ?? []);
}

export function invertSelection(e: Editing) {
  const { selection } = e.editor.state.get();
  const pixels = e.editor.current()?.pixels ?? [];
  e.editor.select(pixels.filter((p) => !selection.has(p.id)).map((p) => p.id));
}

/** Chooses the pixel after (1) or before (-1) the one chosen last, by id; past the end it begins again. */
export function selectNext(e: Editing, by: 1 | -1) {
  const ids = e.editor.current()?.pixels.map((p) => p.id) ?? [];
  const chosen = [...e.editor.state.get().selection];
  const at = chosen.length === 0 ? (by > 0 ? -1 : 0) : ids.indexOf(chosen[chosen.length - 1] ?? -1);
  const next = ids[(at + by + ids.length) % Math.max(1, ids.length)];
  if (next !== undefined) e.editor.select([next]);
}
