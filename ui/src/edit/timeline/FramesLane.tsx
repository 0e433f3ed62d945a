import { useEffect, useMemo, useRef, useState, type KeyboardEvent } from 'react';
import { useStore } from '../../base/store';
import { xOf } from '../../model/timelineAxis';
import * as acts from '../acts';
import { useEditing, useEditorNow } from '../context';
import { NameField } from '../NameField';
import { revealFrame, sayBlock, stepEdge, toggleCues, toggleNail } from './blockActs';
import { edgeKey, takeKey } from './edgeKeys';
import { blockId, FrameBlocks } from './FrameBlocks';
import { framesHand } from './framesHand';
import { useTimelineView, type TrackProps } from './timelineView';
import styles from './Timeline.module.css';

/** The frames on the timeline as a list box, with pointer and keys to choose, change and rename them. */
export function FramesLane({ blocks, axis, drawn }: TrackProps) {
  const editing = useEditing();
  const { editor } = editing;
  const view = useTimelineView();
  const at = useEditorNow((s) => s.frame);
  const chosen = useEditorNow((s) => s.frames);
  const renaming = useStore(editing.renaming);
  const issues = useStore(editing.settled, (plan) => plan?.issues);
  const wrong = useMemo(
    () => new Set(issues?.flatMap((x) => (x.severity === 'error' ? [x.frame] : []))),
    [issues],
  );
  const list = useRef<HTMLDivElement>(null);
  const [lasso, setLasso] = useState<{ left: number; width: number } | null>(null);
  const hand = framesHand(editing, view, axis, setLasso);
  useEffect(() => revealFrame(editing, view, at), [editing, view, at]);

  const choose = (index: number, event: KeyboardEvent) => {
    editing.preview.stop();
    editor.goToFrame(index, event.shiftKey ? 'range' : 'only');
    revealFrame(editing, view, editor.state.get().frame);
    sayBlock(editing, view);
  };
  const press = (event: KeyboardEvent) => {
    const edge = edgeKey(event);
    const all = blocks.map((_, i) => i);
    const isControl = event.ctrlKey || event.metaKey;
    if (edge) stepEdge(editing, view, edge.isEnd ? 'air' : 'travel', edge.by_s);
    else if (isControl && event.key === 'a')
      editor.chooseFrames([at, ...all.filter((i) => i !== at)]);
    else if (isControl || event.altKey) return;
    else if (event.key === 'ArrowLeft') choose(at - 1, event);
    else if (event.key === 'ArrowRight') choose(at + 1, event);
    else if (event.key === 'Home') choose(0, event);
    else if (event.key === 'End') choose(blocks.length - 1, event);
    else if (event.key === 'Enter' || event.key === 'F2') editing.renaming.set(at);
    else if (event.key === 'c') toggleCues(editing, view);
    else if (event.key === 'n') toggleNail(editing, view);
    else return;
    takeKey(event);
  };
  const named = renaming === null ? undefined : blocks[renaming];
  return (
    <>
      <div
        ref={list}
        className={styles.blocks}
        role="listbox"
        tabIndex={0}
        aria-label="Frames on the timeline"
        aria-orientation="horizontal"
        aria-multiselectable
        aria-activedescendant={blocks[at] && blockId(blocks[at])}
        aria-keyshortcuts="[ ] Shift+[ Shift+] C N Enter"
        onPointerDown={hand.down}
        onClick={hand.click}
        onDoubleClick={hand.rename}
        onKeyDown={press}
      >
        <FrameBlocks
          blocks={blocks}
          axis={axis}
          drawn={drawn}
          at={at}
          chosen={chosen}
          wrong={wrong}
        />
      </div>
      {lasso ? <i className={styles.lasso} style={lasso} /> : null}
      {named && renaming !== null ? (
        <div className={styles.naming} style={{ left: xOf(axis, named.driveFrom_s) }}>
          <NameField
            label="Name of the frame"
            name={named.frame.name}
            onName={(name, isByKey) => {
              editing.renaming.set(null);
              if (name) acts.renameFrame(editing, renaming, name);
              if (isByKey) list.current?.focus();
            }}
          />
        </div>
      ) : null}
    </>
  );
}
