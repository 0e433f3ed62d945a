import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import styles from './GoNote.module.css';

/** A frame waits for GO: what it is given for, in large type, above Play. */
export function GoNote() {
  const { live, ask } = useSession();
  const cue = useStore(live.playback, (p) => p.cue);
  const frame = useStore(live.playback, (p) => p.frame);
  const after = useStore(live.playback, (p) => p.next);
  const isPaused = useStore(live.playback, (p) => p.phase === 'paused');
  const frames = useStore(live.opened, (o) => o.show?.frames);
  if (cue === null || frame === null) return null;
  const next = after === null ? undefined : frames?.[after];
  return (
    <div className={styles.note} role="status" data-testid="go-note">
      <div className={styles.words}>
        <strong>{cue || `Frame ${frame + 1} waits for GO`}</strong>
        <span className="quiet">
          {cue ? `Frame ${frame + 1} waits. ` : ''}
          {next && after !== null
            ? `Next: frame ${after + 1}${next.name ? `, ${next.name}` : ''}`
            : 'Then the show ends'}
        </span>
      </div>
      <Button size="lg" disabled={isPaused} onClick={() => void ask({ do: 'go' })}>
        GO (Enter)
      </Button>
    </div>
  );
}
