import { Button } from '@mantine/core';
import { IconAlertTriangle } from '@tabler/icons-react';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { PlayOn } from './StoppedNote';
import styles from './FailureNote.module.css';

/** Place and reason of the last failure, above Play, until the operator dismisses it or starts again. */
export function FailureNote() {
  const { live, ask } = useSession();
  const failure = useStore(live.playback, (p) => p.failure);
  const stopped = useStore(live.playback, (p) => p.stopped_in);
  if (failure === null) return null;
  return (
    <div className={styles.failure} role="alert">
      <IconAlertTriangle size={20} aria-hidden />
      <strong>{failure}</strong>
      {stopped === null ? null : <PlayOn from={stopped} />}
      <Button
        size="compact-sm"
        variant="default"
        onClick={() => void ask({ do: 'dismiss_failure' })}
      >
        Got it
      </Button>
    </div>
  );
}
