import { Button, Group } from '@mantine/core';
import {
  IconHome,
  IconNavigation,
  IconPlayerPauseFilled,
  IconPlayerPlayFilled,
  IconPlayerStopFilled,
  IconPlayerTrackNextFilled,
  IconRefresh,
  IconRepeat,
} from '@tabler/icons-react';
import { useEffect, type ReactNode } from 'react';
import { useStore } from '../base/store';
import { Gate, useWhyNot } from '../parts/Gate';
import { IconButton } from '../parts/IconButton';
import { useSession } from '../session/session';
import { actionsOf, takesGo, type Action } from './actions';
import { ChecklistButton } from './ChecklistButton';
import { DriveDialog } from './DriveDialog';
import { DriveProgress } from './DriveProgress';
import { driveTo } from '../session/drives';
import { MusicButton } from './MusicButton';
import { RoleNote } from './RoleNote';
import { PlayState } from './PlayState';
import { followPlan, startPlay } from '../session/start';
import { useTransportKeys } from './useTransportKeys';
import styles from '../parts/page.module.css';

const ICONS = {
  play: <IconPlayerPlayFilled size={16} />,
  pause: <IconPlayerPauseFilled size={16} />,
  resume: <IconPlayerPlayFilled size={16} />,
  go_on: <IconPlayerPlayFilled size={16} />,
};

const LABELS = { play: 'Play', pause: 'Pause', resume: 'Resume', go_on: 'Go on' };

/** The bar with the buttons that start, pause and stop robots, enabled by the server's state, and the show's state. */
export function Transport() {
  const session = useSession();
  const { live, ask, frame } = session;
  const phase = useStore(live.playback, (p) => p.phase);
  const mayGoOn = useStore(live.playback, (p) => p.may_go_on);
  const mayJump = useStore(live.playback, (p) => p.may_jump);
  const waitsForGo = useStore(live.playback, takesGo);
  const looping = useStore(live.playback, (p) => p.looping);
  const chosen = useStore(frame);
  const linked = useStore(live.link) === 'open';
  const hasShow = useStore(live.opened, (o) => o.show !== null);
  const isWaiting = useStore(session.waiting, (pending) => pending !== null);
  useEffect(() => followPlan(session), [session]);
  const reason = useWhyNot('operator', 'press Play');
  const actions = actionsOf(phase, linked, hasShow, mayGoOn, waitsForGo, mayJump);
  const perform = (action: Action) => {
    if (reason !== null) return;
    if (isWaiting && (action === 'abort' || action === actions.main))
      return session.waiting.set(null);
    if (!actions.enabled.has(action)) return;
    if (action === 'play') return startPlay(session);
    if (action === 'preview') return driveTo(session, chosen);
    if (action === 'home') return driveTo(session, 'home');
    if (action === 'jump') return session.jumpAsked.set(chosen);
    void ask(action === 'loop' ? { do: 'loop', on: !looping } : { do: action });
  };
  useTransportKeys(perform, actions.main);
  const icon = (action: Action, label: string, child: ReactNode, on?: boolean) => (
    <IconButton
      label={label}
      variant={on ? 'light' : 'subtle'}
      color={on ? undefined : 'gray'}
      size="lg"
      aria-pressed={on}
      disabled={!actions.enabled.has(action) && !(isWaiting && action === 'abort')}
      onClick={() => perform(action)}
    >
      {child}
    </IconButton>
  );
  return (
    <div className={styles.bar} role="toolbar" aria-label="Playing">
      <Gate needs="operator" act="press Play">
        <Button
          w={116}
          leftSection={ICONS[actions.main]}
          disabled={!actions.enabled.has(actions.main)}
          onClick={() => perform(actions.main)}
        >
          {isWaiting ? 'Cancel' : LABELS[actions.main]}
        </Button>
        <Group gap={2} wrap="nowrap">
          {icon('abort', 'Abort (Esc)', <IconPlayerStopFilled size={18} />)}
          {icon('step', 'Step to the next frame (S)', <IconPlayerTrackNextFilled size={18} />)}
          {icon('preview', 'Drive robots to this frame (P)', <IconNavigation size={19} />)}
          {icon('home', 'Home: drive robots to their starting places', <IconHome size={19} />)}
          {icon('loop', 'Loop (L)', <IconRepeat size={18} />, looping)}
          <ChecklistButton />
          {icon('refresh', 'Look for robots (R)', <IconRefresh size={18} />)}
        </Group>
      </Gate>
      <MusicButton />
      <RoleNote />
      <DriveProgress />
      <PlayState />
      <DriveDialog />
    </div>
  );
}
