import { secondsText, shortSeconds } from '../../base/time';
import { setFrames } from '../../model/commands';
import { cueOf, setCue } from '../../model/cues';
import { xOf } from '../../model/timelineAxis';
import {
  blocksOf,
  dragBlockEdge,
  isFastest,
  stretchBlocks,
  type Block,
  type BlockEdge,
} from '../../model/timelineBlocks';
import * as acts from '../acts';
import type { Editing } from '../editing';
import type { PointerDrag } from './followPointer';
import { blocksNow, dragOf } from './timelineDrag';
import { axisOf, reveal, type TimelineView } from './timelineView';

const EDGE_LABEL: Record<BlockEdge, string> = { travel: 'Travel time', air: 'Air time' };

export const chosenFrames = ({ editor }: Editing) =>
  [...editor.state.get().frames].sort((a, b) => a - b);

/** A frame with its times, as text for people. */
export function blockText(block: Block, index: number): string {
  const { frame, least_s, go } = block;
  const travel_s = block.shownFrom_s - block.driveFrom_s;
  const least = isFastest(block) ? 'the least' : `at least ${secondsText(least_s ?? 0)}`;
  const drive =
    least_s === null ? 'drive not planned yet' : `drive ${secondsText(travel_s)}, ${least}`;
  const wait = go === null ? '' : go === 'waits' ? '; waits for GO' : '; repeats until GO';
  const nailed = frame.at_s === null ? '' : `; fixed at ${shortSeconds(frame.at_s)} s`;
  const name = `Frame ${index + 1} ${frame.name}`.trim();
  return `${name}: ${drive}; shown for ${shortSeconds(frame.airTime_s)} s${wait}${nailed}`;
}

/** Writes the frame on the stage with its times into the status line. */
export function sayBlock(editing: Editing, view: TimelineView) {
  const { frame } = editing.editor.state.get();
  const block = blocksNow(editing, view)[frame];
  if (block) view.status.set(blockText(block, frame));
}

/** A drag of an edge of a block; chosen frames change alike. Null: no such block, or its drive is not planned yet. */
export function dragEdge(
  editing: Editing,
  view: TimelineView,
  index: number,
  edge: BlockEdge,
): PointerDrag | null {
  const block = blocksNow(editing, view)[index];
  if (!block) return null;
  if (edge === 'travel' && block.least_s === null) {
    view.status.set('The drive to this frame is not planned yet: its least time is not known.');
    return null;
  }
  const chosen = chosenFrames(editing);
  const from_s = edge === 'air' ? block.until_s : block.shownFrom_s;
  const say = () => {
    const now = blocksNow(editing, view)[index];
    if (now) view.status.set(blockText(now, index));
  };
  return dragOf(
    editing,
    view,
    EDGE_LABEL[edge],
    { what: 'block', index },
    from_s,
    (show, blocks, to_s) => dragBlockEdge(show, blocks, chosen, index, edge, to_s),
    say,
  );
}

/** Gives the chosen frames more or less travel time or air time, seconds. */
export function stepEdge(editing: Editing, view: TimelineView, edge: BlockEdge, by_s: number) {
  const chosen = chosenFrames(editing);
  editing.editor.change(EDGE_LABEL[edge], (show) =>
    stretchBlocks(show, blocksOf(show, view.drives.get()), chosen, edge, by_s),
  );
  sayBlock(editing, view);
}

/** Lets the show wait for GO after a frame, or go on by itself if it waits or repeats. */
export function toggleCue(editing: Editing, index: number) {
  editing.editor.change('Cue', (show) => {
    const isThere = cueOf(show, show.frames[index]) !== null;
    return setCue(show, [index], isThere ? null : '');
  });
}

/** Lets the show wait for GO after the chosen frames, or go on by itself if the frame on the stage has a cue. */
export function toggleCues(editing: Editing, view: TimelineView) {
  const { show, frame } = editing.editor.state.get();
  acts.setCue(editing, cueOf(show, show.frames[frame]) === null ? '' : null);
  sayBlock(editing, view);
}

/** Fixes the frame on the stage to the show time at which it begins now, or frees it; not the first frame. */
export function toggleNail(editing: Editing, view: TimelineView) {
  const { frame } = editing.editor.state.get();
  const block = blocksNow(editing, view)[frame];
  if (!block || frame === 0) return;
  const at_s = block.frame.at_s === null ? Math.round(block.shownFrom_s * 100) / 100 : null;
  editing.editor.change('Fixed time', (show) => setFrames(show, [frame], { at_s }));
  sayBlock(editing, view);
}

/** Scrolls the frame at `index` into sight, unless a preview is on the stage. */
export function revealFrame(editing: Editing, view: TimelineView, index: number) {
  const blocks = blocksNow(editing, view);
  const block = blocks[index];
  if (!block || editing.preview.time_s.get() !== null) return;
  const axis = axisOf(editing.editor.state.get().show, blocks, view.scale.get());
  reveal(view, xOf(axis, block.driveFrom_s), xOf(axis, block.until_s));
}
