import { useEffect, useMemo, useRef, useState, type KeyboardEvent } from 'react';
import { useStore } from '../../base/store';
import { xOf } from '../../model/timelineAxis';
import { isFastest } from '../../model/timelineBlocks';
import * as acts from '../acts';
import { useEditing, useEditorNow } from '../context';
import { NameField } from '../NameField';
import { blockText, revealFrame, sayBlock, stepEdge, toggleCues, toggleNail } from './blockActs';
import { edgeKey, takeKey } from './edgeKeys';
import { FrameBlock } from './FrameBlock';
import { framesHand } from './framesHand';
import { useTimelineView, type TrackProps } from './timelineView';
import styles from './Timeline.module.css';

/** The frames on the timeline. */
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
        aria-activedescendant={idOf(blocks[at]?.key)}
        aria-keyshortcuts="[ ] Shift+[ Shift+] C N Enter"
        onPointerDown={hand.down}
        onClick={hand.click}
        onDoubleClick={hand.rename}
        onKeyDown={press}
      >
        {groupsOf(blocks.length).map((group) => {
          const origin_px = xOf(axis, blocks[group[0] ?? 0]?.driveFrom_s ?? 0);
          const made = group.flatMap((i) => {
            const block = blocks[i];
            if (!block) return [];
            const left = xOf(axis, block.driveFrom_s);
            const width = xOf(axis, block.until_s) - left;
            // The chosen one is there also when it is out of sight: the list says which it is.
            const isDrawn = left < drawn.to_px && left + width > drawn.from_px;
            if (!isDrawn && i !== at) return [];
            const travel_s = block.shownFrom_s - block.driveFrom_s;
            return [
              <FrameBlock
                key={block.key}
                id={idOf(block.key) ?? ''}
                index={i}
                frame={block.frame}
                left={steady(left - origin_px)}
                width={steady(width)}
                travel_px={steady(travel_s * axis.scale)}
                travel_s={steady(travel_s)}
                least_s={block.least_s}
                least_px={(block.least_s ?? 0) * axis.scale}
                isFastest={isFastest(block)}
                isChosen={chosen.has(i)}
                isCurrent={i === at}
                isWrong={wrong.has(i)}
                go={block.go}
                label={blockText(block, i)}
              />,
            ];
          });
          return made.length === 0 ? null : (
            <div
              key={group[0]}
              role="presentation"
              className={styles.group}
              style={{ left: origin_px }}
            >
              {made}
            </div>
          );
        })}
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

/** Blocks beside each other that a drag before them moves as one: it makes all later ones go the same way. */
const GROUP = 12;

const groupsOf = (count: number): number[][] =>
  Array.from({ length: Math.ceil(count / GROUP) }, (_, group) =>
    Array.from({ length: Math.min(GROUP, count - group * GROUP) }, (__, i) => group * GROUP + i),
  );

/** The same number for differences that were computed in other ways, so that nothing is drawn for rounding. */
const steady = (value: number) => Math.round(value * 1e3) / 1e3;

const idOf = (key: number | undefined) => (key === undefined ? undefined : `timeline-frame-${key}`);
