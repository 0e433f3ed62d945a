import type { MouseEvent, PointerEvent } from 'react';
import { momentAt, type Axis } from '../../model/timelineAxis';
import { blocksBetween, type BlockEdge } from '../../model/timelineBlocks';
import type { Editing } from '../editing';
import { blocksNow } from './timelineDrag';
import { dragEdge, sayBlock, toggleCue } from './blockActs';
import { followPointer } from './followPointer';
import type { TimelineView } from './timelineView';

type Lasso = { left: number; width: number } | null;

/** What a pointer on the frames of the timeline does: drags edges, chooses and renames frames, and sets cues. */
export function framesHand(
  editing: Editing,
  view: TimelineView,
  axis: Axis,
  setLasso: (lasso: Lasso) => void,
) {
  const { editor, preview } = editing;
  const frameAt = (event: MouseEvent) => {
    const block = (event.target as HTMLElement).closest<HTMLElement>('[data-frame]');
    return block ? Number(block.dataset.frame) : null;
  };
  const adds = (event: MouseEvent) => event.ctrlKey || event.metaKey || event.shiftKey;

  /** A drag over blocks or beside them chooses the frames that it touches; with Ctrl or Shift, in addition. */
  const chooseAround = (event: PointerEvent) => {
    const lane = event.currentTarget.getBoundingClientRect();
    const from_px = event.clientX - lane.left;
    const before = adds(event) ? [...editor.state.get().frames] : [];
    let to_px = from_px;
    followPointer(event, view.scroller, {
      move(by_px) {
        to_px = from_px + by_px;
        setLasso({ left: Math.min(from_px, to_px), width: Math.abs(by_px) });
      },
      end() {
        setLasso(null);
        if (to_px === from_px) return;
        const blocks = blocksNow(editing, view);
        const touched = blocksBetween(blocks, momentAt(axis, from_px), momentAt(axis, to_px));
        preview.stop();
        editor.chooseFrames([...new Set([...touched, ...before])]);
        view.status.set(`${editor.state.get().frames.size} frames chosen`);
      },
      cancel: () => setLasso(null),
    });
  };

  return {
    down(event: PointerEvent) {
      if (event.button !== 0) return;
      const target = event.target as HTMLElement;
      const edge = target.dataset.edge as BlockEdge | undefined;
      const index = frameAt(event);
      if (edge && index !== null) {
        const drag = dragEdge(editing, view, index, edge);
        if (!drag) return;
        followPointer(event, view.scroller, {
          ...drag,
          move(by_px, moved) {
            if (!editor.state.get().frames.has(index)) editor.goToFrame(index);
            drag.move(by_px, moved);
          },
        });
        // A finger that is not on an edge scrolls the timeline.
      } else if (event.pointerType !== 'touch') chooseAround(event);
    },
    click(event: MouseEvent) {
      const target = event.target as HTMLElement;
      const index = frameAt(event);
      if (index === null) return;
      if (target.closest('[data-cue]')) return toggleCue(editing, index);
      preview.stop();
      const how = event.shiftKey ? 'range' : event.ctrlKey || event.metaKey ? 'toggle' : 'only';
      editor.goToFrame(index, how);
      sayBlock(editing, view);
    },
    rename(event: MouseEvent) {
      const target = event.target as HTMLElement;
      const index = frameAt(event);
      if (index !== null && !target.closest('[data-edge], [data-cue]')) editing.renaming.set(index);
    },
  };
}
