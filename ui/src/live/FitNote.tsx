import { Button } from '@mantine/core';
import { IconInfoCircle } from '@tabler/icons-react';
import { countText } from '../base/numbers';
import { useStore } from '../base/store';
import { fleetSize } from '../model/commands';
import { robotsToFit } from '../session/fitness';
import { useSession } from '../session/session';
import styles from './FitNote.module.css';

/** While the show is ready to play, offers to fit it to the robots that can drive, if their number does not fit it. */
export function FitNote() {
  const { live, fitting } = useSession();
  const { show, readOnly } = useStore(live.opened);
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const isReady = useStore(live.playback, (p) => p.phase === 'ready');
  const robots = robotsToFit(show, readOnly, rows);
  if (!show || robots === null || !isReady) return null;
  return (
    <div className={styles.note} role="status" data-testid="fit-note">
      <IconInfoCircle size={18} aria-hidden />
      <span>
        The show has {countText(fleetSize(show), 'pixel')}, and {countText(robots, 'robot')}{' '}
        {robots === 1 ? 'is' : 'are'} here.
      </span>
      <Button size="compact-sm" variant="default" onClick={() => fitting.set(robots)}>
        Fit to {countText(robots, 'robot')}…
      </Button>
    </div>
  );
}
