import { Button, Slider } from '@mantine/core';
import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconPlayerPauseFilled,
  IconPlayerPlayFilled,
} from '@tabler/icons-react';
import { useMemo, type ReactNode } from 'react';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import { IconButton } from '../parts/IconButton';
import { timelineOf, totalOf } from '../model/timeline';
import { openShow } from '../session/openShow';
import { startPlay } from '../session/start';
import { useSession } from '../session/session';
import { goTo } from '../session/address';
import { useEditing, useEditor } from './context';
import { HistoryMenu } from './HistoryMenu';
import { ExportMenu } from './ExportMenu';
import { SaveMark } from './SaveMark';
import { StatesButton } from './StatesButton';
import page from '../parts/page.module.css';
import styles from './EditBar.module.css';

/** Undo, preview, scrubbing, and the state of saving. */
export function EditBar() {
  const session = useSession();
  const editing = useEditing();
  const { editor } = editing;
  const show = useEditor((s) => s.show);
  const canUndo = useEditor((s) => s.history.past.length > 0);
  const canRedo = useEditor((s) => s.history.future.length > 0);
  const { preview } = editing;
  const running = useStore(preview.running);
  const time_s = useStore(preview.time_s);
  const plan = useStore(editing.settled);
  const frame = useEditor((s) => s.frame);
  const isMaking = useStore(editing.making, (making) => making !== null);
  const timeline = useMemo(() => timelineOf(show, plan), [show, plan]);
  const total = totalOf(timeline);
  const at = time_s ?? timeline[frame]?.shownFrom_s ?? 0;
  /** Runs the whole show from its first frame; the live view shows what is missing. */
  const playWithRobots = async () => {
    editing.saver.flush();
    const isOpen = session.live.opened.get().name === editing.name;
    if (!isOpen && !(await openShow(session, editing.name))) return;
    session.frame.set(0);
    goTo('live');
    if (session.live.playback.get().phase === 'ready') startPlay(session);
  };
  const step = (label: string, enabled: boolean, act: () => void, icon: ReactNode) => (
    <IconButton label={label} size="lg" disabled={!enabled} onClick={act}>
      {icon}
    </IconButton>
  );
  return (
    <div className={page.bar} role="toolbar" aria-label="Editing">
      {step('Undo (Ctrl Z)', canUndo, () => void editor.undo(), <IconArrowBackUp size={19} />)}
      {step(
        'Redo (Ctrl Shift Z)',
        canRedo,
        () => void editor.redo(),
        <IconArrowForwardUp size={19} />,
      )}
      <HistoryMenu />
      {step(
        running ? 'Pause (Space)' : 'Preview (Space)',
        true,
        preview.toggle,
        running ? <IconPlayerPauseFilled size={18} /> : <IconPlayerPlayFilled size={18} />,
      )}
      <Slider
        className={page.progress}
        size="sm"
        label={(value) => clockText(value)}
        thumbLabel="Moment of the show"
        min={0}
        max={Math.max(total, 0.1)}
        step={0.05}
        value={at}
        onChange={(to_s) => preview.scrub(timeline, to_s)}
      />
      <span className={`quiet ${styles.time}`}>
        {clockText(at)} / {clockText(total)}
      </span>
      <SaveMark />
      <StatesButton />
      <ExportMenu />
      <Button
        size="xs"
        // While a frame is made, Use is what comes next.
        variant={isMaking ? 'default' : 'filled'}
        onClick={() => void playWithRobots()}
        leftSection={<IconPlayerPlayFilled size={14} />}
      >
        Run on robots
      </Button>
    </div>
  );
}
