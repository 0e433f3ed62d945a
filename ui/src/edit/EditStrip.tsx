import { useCallback, useEffect } from 'react';
import type { Plan } from '../api/types.gen';
import { useStore } from '../base/store';
import * as acts from './acts';
import { goOf } from '../model/cues';
import { useEditing, useEditor } from './context';
import { FrameButtons } from './FrameButtons';
import { FrameCard } from './FrameCard';
import { useReorder } from './useReorder';
import strip from '../parts/strip.module.css';
import styles from './EditStrip.module.css';

/** Planned travel time to a frame, seconds, as text; empty while it is not planned. */
function driveOf(plan: Plan | null, index: number): string {
  const drive_s = plan?.transitions[index]?.duration_s;
  return drive_s === undefined ? '' : drive_s.toFixed(1);
}

/** The frames as pictures in a row: choose, rename, add, copy, delete, drag to another place. */
export function EditStrip() {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const at = useEditor((s) => s.frame);
  const chosen = useEditor((s) => s.frames);
  const plan = useStore(editing.settled);
  const renaming = useStore(editing.renaming);
  const drop = useCallback(
    (from: number, to: number) => acts.dropFrames(editing, from, to),
    [editing],
  );
  const { list, begin, end, target } = useReorder(drop);
  useEffect(() => {
    list.current?.children[at]?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }, [at, list]);
  const choose = (
    index: number,
    event: { shiftKey: boolean; ctrlKey: boolean; metaKey: boolean },
  ) => {
    editing.preview.stop();
    const add = event.ctrlKey || event.metaKey;
    editing.editor.goToFrame(index, event.shiftKey ? 'range' : add ? 'toggle' : 'only');
  };
  return (
    <div className={styles.row}>
      <div className={styles.buttons}>
        <FrameButtons position="right" />
      </div>
      <ul className={`${strip.strip} ${styles.frames}`} ref={list} aria-label="Frames">
        {show.frames.map((frame, i) => (
          <li key={frame.key} {...target(i)}>
            <FrameCard
              frame={frame}
              index={i}
              stage={show.stage}
              current={i === at}
              chosen={chosen.has(i)}
              go={goOf(show, i)}
              drive={driveOf(plan, i)}
              wrong={plan?.issues.some((x) => x.frame === i && x.severity === 'error') ?? false}
              onChoose={(event) => choose(i, event)}
              naming={renaming === i}
              onName={(name) => {
                editing.renaming.set(null);
                if (name) acts.renameFrame(editing, i, name);
              }}
              onRename={() => editing.renaming.set(i)}
              onDragStart={() => begin(i)}
              onDragEnd={end}
            />
          </li>
        ))}
      </ul>
    </div>
  );
}
