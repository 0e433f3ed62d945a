import { IconCopy, IconPlus, IconTrash } from '@tabler/icons-react';
import { useCallback, useEffect, useRef, useState, type ReactNode } from 'react';
import type { Plan } from '../api/types.gen';
import { useStore } from '../base/store';
import { IconButton } from '../parts/IconButton';
import * as acts from './acts';
import { cueOf } from '../model/cues';
import { useEditing, useEditor } from './context';
import { FrameCard } from './FrameCard';
import { listenToHold } from './holdDrag';
import strip from '../parts/strip.module.css';
import styles from './EditStrip.module.css';

/** Travel time to a frame, seconds, as text. */
function driveOf(plan: Plan | null, index: number): string {
  const drive_s = plan?.transitions[index]?.duration_s;
  return drive_s === undefined ? '' : drive_s.toFixed(1);
}

/** The frames: choose, add, copy, delete, drag to another place. */
export function EditStrip() {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const at = useEditor((s) => s.frame);
  const chosen = useEditor((s) => s.frames);
  const plan = useStore(editing.settled);
  const [over, setOver] = useState<number | null>(null);
  const renaming = useStore(editing.renaming);
  const dragged = useRef<number | null>(null);
  const list = useRef<HTMLUListElement>(null);
  useEffect(() => {
    list.current?.children[at]?.scrollIntoView({ block: 'nearest', inline: 'nearest' });
  }, [at]);
  const choose = (
    index: number,
    event: { shiftKey: boolean; ctrlKey: boolean; metaKey: boolean },
  ) => {
    editing.preview.stop();
    const add = event.ctrlKey || event.metaKey;
    editing.editor.goToFrame(index, event.shiftKey ? 'range' : add ? 'toggle' : 'only');
  };
  const drop = useCallback(
    (to: number) => {
      const from = dragged.current;
      dragged.current = null;
      setOver(null);
      if (from !== null) acts.dropFrames(editing, from, to);
    },
    [editing],
  );
  useEffect(
    () =>
      list.current
        ? listenToHold(list.current, {
            begin: (index) => setOver((dragged.current = index)),
            over: setOver,
            drop,
            giveUp: () => setOver((dragged.current = null)),
          })
        : undefined,
    [drop],
  );
  const button = (label: string, act: () => void, icon: ReactNode, off = false) => (
    <IconButton
      label={label}
      position="right"
      variant="default"
      color={undefined}
      size="lg"
      disabled={off}
      onClick={act}
    >
      {icon}
    </IconButton>
  );
  return (
    <div className={styles.row}>
      <div className={styles.buttons}>
        {button('Add a frame (Ctrl Enter)', () => acts.addFrame(editing), <IconPlus size={18} />)}
        {button('Duplicate (Ctrl D)', () => acts.duplicateFrames(editing), <IconCopy size={17} />)}
        {button(
          'Delete (Ctrl Delete)',
          () => acts.deleteFrames(editing),
          <IconTrash size={17} />,
          show.frames.length <= chosen.size,
        )}
      </div>
      <ul className={`${strip.strip} ${styles.frames}`} ref={list} aria-label="Frames">
        {show.frames.map((frame, i) => (
          <li
            key={frame.key}
            data-over={over === i || undefined}
            onDragOver={(event) => {
              if (dragged.current === null) return;
              event.preventDefault();
              setOver(i);
            }}
            onDrop={() => drop(i)}
          >
            <FrameCard
              frame={frame}
              index={i}
              stage={show.stage}
              current={i === at}
              chosen={chosen.has(i)}
              waits={cueOf(show, frame) !== null}
              drive={driveOf(plan, i)}
              wrong={plan?.issues.some((x) => x.frame === i && x.severity === 'error') ?? false}
              onChoose={(event) => choose(i, event)}
              naming={renaming === i}
              onName={(name) => {
                editing.renaming.set(null);
                if (name) acts.renameFrame(editing, i, name);
              }}
              onRename={() => editing.renaming.set(i)}
              onDragStart={() => (dragged.current = i)}
              onDragEnd={() => setOver((dragged.current = null))}
            />
          </li>
        ))}
      </ul>
    </div>
  );
}
