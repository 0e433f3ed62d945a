import { Button } from '@mantine/core';
import {
  IconArrowBackUp,
  IconArrowForwardUp,
  IconDeviceProjector,
  IconPlayerPauseFilled,
  IconPlayerPlayFilled,
  IconTimeline,
} from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useStore } from '../base/store';
import { IconButton } from '../parts/IconButton';
import { openShow } from '../session/openShow';
import { startPlay } from '../session/start';
import { useSession } from '../session/session';
import { goTo } from '../session/address';
import { showAudience } from './AudiencePreview';
import { useEditing, useEditor } from './context';
import { HistoryMenu } from './HistoryMenu';
import { ExportMenu } from './ExportMenu';
import { SaveMark } from './SaveMark';
import { Scrubber } from './Scrubber';
import { StatesButton } from './StatesButton';
import { framesView, toggleFramesView } from './timeline/framesView';
import page from '../parts/page.module.css';

/** The editor's bar: history, preview, scrubbing, timeline, saving, export, and Run on robots. */
export function EditBar() {
  const session = useSession();
  const editing = useEditing();
  const { editor } = editing;
  const canUndo = useEditor((s) => s.history.past.length > 0);
  const canRedo = useEditor((s) => s.history.future.length > 0);
  const { preview } = editing;
  const running = useStore(preview.running);
  const isTimeline = useStore(framesView, (view) => view === 'timeline');
  const isMaking = useStore(editing.making, (making) => making !== null);
  /** Saves, opens the show and goes to the live view. If the playback is ready, it starts from the first frame. */
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
      {step(
        'Audience view of the preview (A)',
        true,
        () => showAudience(editing),
        <IconDeviceProjector size={18} />,
      )}
      <Scrubber />
      <IconButton
        label="Timeline (L)"
        size="lg"
        variant={isTimeline ? 'filled' : 'subtle'}
        aria-pressed={isTimeline}
        onClick={toggleFramesView}
      >
        <IconTimeline size={18} />
      </IconButton>
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
