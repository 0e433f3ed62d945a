import { createContext, useContext } from 'react';
import { flushSync } from 'react-dom';
import { createStore, type Store } from '../../base/store';
import { layersOf } from '../../model/layers';
import type { Show } from '../../model/show';
import { fittingScale, withinScales, type Axis } from '../../model/timelineAxis';
import { plannedDrives, type Block, type PlannedDrives } from '../../model/timelineBlocks';
import { markersOf, sectionsOf } from '../../model/timelineMarks';
import type { Editing } from '../editing';

/** A marker or a section, by its index in the document's list. */
export interface ChosenMark {
  kind: 'marker' | 'section';
  index: number;
}

/** What the timeline of this screen shows, and where. */
export interface TimelineView {
  /** The element that scrolls; null while the timeline is not on the page. */
  scroller: HTMLElement | null;
  /** Zoom, CSS pixels a second. */
  scale: Store<number>;
  /** The part of the timeline that is drawn: what is seen, and some more around it. */
  drawn: Store<Drawn>;
  /** Whether drags snap. */
  snaps: Store<boolean>;
  /** What was done last, for the status line. */
  status: Store<string>;
  mark: Store<ChosenMark | null>;
  /** The marker or section that is being renamed; null: none. */
  naming: Store<ChosenMark | null>;
  drives: Store<PlannedDrives>;
  /** Moments of beats that drags snap to, seconds of show time. */
  beats: Store<readonly number[]>;
  /** Keeps the planned drives up to date until the returned function is called. */
  follow(): () => void;
}

/** A part of the timeline. */
export interface Drawn {
  /** Ends in the lanes, CSS pixels. */
  from_px: number;
  to_px: number;
  /** The first drawn row of layers, the uppermost being 0, and the row after the last drawn one. */
  fromRow: number;
  toRow: number;
}

/** What the rows of the timeline are drawn from. */
export interface TrackProps {
  show: Show;
  blocks: readonly Block[];
  axis: Axis;
  drawn: Drawn;
}

/** Factor of one step of the zoom. */
export const ZOOM_STEP = 1.4;

/** Zoom before the timeline is measured, then the least and the largest zoom to begin with, CSS pixels a second. */
const [FIRST_SCALE, FIRST_SCALE_MIN, FIRST_SCALE_MAX] = [24, 16, 60];

export function createTimelineView({ editor, settled }: Editing): TimelineView {
  const drives = createStore(plannedDrives(editor.state.get().show, settled.get()));
  const take = () => drives.set(plannedDrives(editor.state.get().show, settled.get()));
  return {
    scroller: null,
    scale: createStore(FIRST_SCALE),
    drawn: createStore<Drawn>({ from_px: 0, to_px: 0, fromRow: 0, toRow: 0 }),
    snaps: createStore(true),
    status: createStore(''),
    mark: createStore<ChosenMark | null>(null),
    naming: createStore<ChosenMark | null>(null),
    drives,
    beats: createStore<readonly number[]>([]),
    follow: () => settled.subscribe(take),
  };
}

export const TimelineContext = createContext<TimelineView | null>(null);

export function useTimelineView(): TimelineView {
  const view = useContext(TimelineContext);
  if (!view) throw new Error('There is no timeline around this component.');
  return view;
}

/** Room after the last thing on the timeline, into which its end can be dragged, CSS pixels. */
const ROOM_PX = 120;

/** The timeline of a show at a zoom: from the first drive to its last thing, and `ROOM_PX` more. */
export function axisOf(show: Show, blocks: readonly Block[], scale: number): Axis {
  const from_s = Math.min(0, blocks[0]?.driveFrom_s ?? 0);
  return { from_s, to_s: endOf(show, blocks) + ROOM_PX / scale, scale };
}

const endOf = (show: Show, blocks: readonly Block[]) =>
  Math.max(
    blocks[blocks.length - 1]?.until_s ?? 0,
    ...markersOf(show).map(({ at_s }) => at_s),
    ...sectionsOf(show).map(({ to_s }) => to_s),
    ...layersOf(show).map(({ when }) => (when.of === 'seconds' ? when.to_s : 0)),
  );

/** Width of the column of names, CSS pixels. */
export const namesWidth = ({ scroller }: TimelineView) =>
  scroller?.querySelector('[data-names]')?.getBoundingClientRect().width ?? 0;

/** Width of the part of the lanes in sight, CSS pixels; 0 while the timeline is not on the page. */
export const seenWidth = (view: TimelineView) =>
  Math.max(0, (view.scroller?.clientWidth ?? 0) - namesWidth(view));

/** The zoom that shows the whole timeline without its `ROOM_PX`, within the limits of the zoom. */
export const wholeScale = (view: TimelineView, axis: Axis) =>
  fittingScale(axis.to_s - ROOM_PX / axis.scale - axis.from_s, seenWidth(view) - 24);

/** The zoom that a timeline begins with: the whole timeline, but within `FIRST_SCALE_MIN` and `FIRST_SCALE_MAX`. */
export const firstScale = (view: TimelineView, axis: Axis) =>
  Math.max(FIRST_SCALE_MIN, Math.min(FIRST_SCALE_MAX, wholeScale(view, axis)));

/** Height of a row of layers, CSS pixels, as the style sheet has it. */
export const layerHeight = () => (matchMedia('(pointer: coarse)').matches ? 44 : 32);

/**
 * Sets `drawn` to the part in sight and some around it. It changes in steps of an eighth of the width, at least 80 px,
 * and of four rows, so that scrolling is cheap.
 */
export function noteSeen(view: TimelineView) {
  const { scroller } = view;
  if (!scroller) return;
  const width = seenWidth(view);
  const step = Math.max(80, width / 8);
  const rows = 4;
  const row = Math.floor(scroller.scrollTop / layerHeight() / rows) * rows;
  const next: Drawn = {
    from_px: (Math.floor(scroller.scrollLeft / step) - 1) * step,
    to_px: (Math.floor((scroller.scrollLeft + width) / step) + 2) * step,
    fromRow: Math.max(0, row - rows),
    toRow: row + Math.ceil(scroller.clientHeight / layerHeight()) + 2 * rows,
  };
  const now = view.drawn.get();
  if (Object.entries(next).some(([name, value]) => now[name as keyof Drawn] !== value))
    view.drawn.set(next);
}

/** Zooms by `factor` about `at_px`, CSS pixels from the left of the part in sight; by default about its middle. */
export function zoomTimeline(view: TimelineView, factor: number, at_px = seenWidth(view) / 2) {
  const { scroller } = view;
  const before = view.scale.get();
  const after = withinScales(before * factor);
  if (!scroller || after === before) return;
  const left = ((scroller.scrollLeft + at_px) / before) * after - at_px;
  // The lanes need their new width before they are scrolled.
  flushSync(() => view.scale.set(after));
  scroller.scrollLeft = left;
  noteSeen(view);
}

/** Scrolls a stretch of the lanes, CSS pixels, into sight; if it is too wide, its begin. */
export function reveal(view: TimelineView, from_px: number, to_px: number) {
  const { scroller } = view;
  if (!scroller) return;
  const [left, width] = [scroller.scrollLeft, seenWidth(view)];
  if (from_px < left) scroller.scrollLeft = Math.max(0, from_px - 16);
  else if (to_px > left + width) scroller.scrollLeft = Math.min(from_px - 16, to_px - width + 32);
}

/** Scrolls a row of layers, the uppermost being 0, into sight. */
export function revealRow({ scroller }: TimelineView, row: number) {
  const head = scroller?.querySelector('[data-head]')?.clientHeight ?? 0;
  if (!scroller) return;
  const [top, height] = [row * layerHeight(), scroller.clientHeight - head];
  if (top < scroller.scrollTop) scroller.scrollTop = top;
  else if (top + layerHeight() > scroller.scrollTop + height)
    scroller.scrollTop = top + layerHeight() - height;
}
