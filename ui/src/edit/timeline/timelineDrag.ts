import type { Show } from '../../model/show';
import { timelineOf } from '../../model/timeline';
import { dragStep_s, snapMoment } from '../../model/timelineAxis';
import { blocksOf, momentOnStage, type Block } from '../../model/timelineBlocks';
import { snapMoments, type Dragged } from '../../model/timelineSnap';
import type { Editing } from '../editing';
import type { PointerDrag } from './followPointer';
import { axisOf, noteSeen, wholeScale, type TimelineView } from './timelineView';

/** Distance within which drags snap, CSS pixels. */
const REACH_PX = 7;

export const blocksNow = ({ editor }: Editing, view: TimelineView): Block[] =>
  blocksOf(editor.state.get().show, view.drives.get());

/** Moment of show time on the stage, seconds. */
export function playhead_s({ editor, preview }: Editing, blocks: readonly Block[]): number {
  return momentOnStage(blocks, editor.state.get().frame, preview.time_s.get());
}

/** Puts a moment of show time on the stage. */
export function scrubTo({ editor, preview, settled }: Editing, at_s: number) {
  const timeline = timelineOf(editor.state.get().show, settled.get());
  preview.scrub(timeline, Math.max(0, at_s + (timeline[0]?.shownFrom_s ?? 0)));
}

/**
 * A drag on the timeline that changes the show as one step of the history. `from_s`: show time of the dragged thing at
 * the beginning. `change`: given the show and blocks of the beginning, the show in which the thing is at `to_s`.
 */
export function dragOf(
  editing: Editing,
  view: TimelineView,
  label: string,
  dragged: Dragged,
  from_s: number,
  change: (show: Show, blocks: readonly Block[], to_s: number) => Show,
  say: () => void,
): PointerDrag {
  const { editor } = editing;
  const [start, blocks, scale] = [
    editor.state.get().show,
    blocksNow(editing, view),
    view.scale.get(),
  ];
  const more = [playhead_s(editing, blocks), ...view.beats.get()];
  const moments = snapMoments(start, blocks, dragged, more);
  editor.begin();
  return {
    move(by_px, event) {
      if (!editor.isGesturing()) return;
      const to_s = from_s + by_px / scale;
      const isFree = event.altKey || !view.snaps.get();
      const at_s = isFree ? to_s : snapMoment(to_s, moments, REACH_PX / scale, dragStep_s(scale));
      editor.change(label, () => change(start, blocks, at_s));
      say();
    },
    end() {
      if (editor.isGesturing()) editor.commit(label);
    },
    cancel() {
      if (editor.isGesturing()) editor.cancel();
    },
  };
}

/** Zooms so that the whole timeline is seen, within the limits of the zoom, and scrolls to its begin. */
export function fitTimeline(editing: Editing, view: TimelineView) {
  const blocks = blocksNow(editing, view);
  const axis = axisOf(editing.editor.state.get().show, blocks, view.scale.get());
  view.scale.set(wholeScale(view, axis));
  if (view.scroller) view.scroller.scrollLeft = 0;
  noteSeen(view);
}
