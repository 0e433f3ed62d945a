import { Button } from '@mantine/core';
import type { ReactNode } from 'react';
import type { Frame } from '../model/show';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { repeatsText } from './cueRows';
import styles from './GoNote.module.css';

/** While a frame waits for GO, or frames repeat until GO: the name of the cue in large type, and the button GO. */
export function GoNote() {
  const { live } = useSession();
  const cue = useStore(live.playback, (p) => p.cue);
  const frame = useStore(live.playback, (p) => p.frame);
  const after = useStore(live.playback, (p) => p.next);
  // A text, not the object, because an equal text does not render this again with each message.
  const repeats = useStore(live.playback, (p) => (p.repeats ? repeatsText(p.repeats) : null));
  const leaves = useStore(live.playback, (p) => p.repeats?.leaves ?? false);
  const last = useStore(live.playback, (p) => p.repeats?.last ?? null);
  const looping = useStore(live.playback, (p) => p.looping);
  const frames = useStore(live.opened, (o) => o.show?.frames);
  if (frame === null) return null;
  if (cue !== null)
    return (
      <Words title={cue || `Frame ${frame + 1} waits for GO`} gives>
        {cue ? `Frame ${frame + 1} waits. ` : ''}
        {nextText('Next', frames, after)}
      </Words>
    );
  if (repeats === null || last === null) return null;
  const isEnd = last + 1 >= (frames?.length ?? 0);
  const on = isEnd ? (looping ? 0 : null) : last + 1;
  return (
    <Words title={repeats} gives={!leaves}>
      {nextText('Then', frames, on)}
    </Words>
  );
}

function nextText(when: string, frames: readonly Frame[] | undefined, index: number | null) {
  const frame = index === null ? undefined : frames?.[index];
  if (index === null || !frame) return 'Then the show ends';
  return `${when}: frame ${index + 1}${frame.name ? `, ${frame.name}` : ''}`;
}

/** `gives`: whether the button that gives GO is shown. */
function Words({ title, gives, children }: { title: string; gives: boolean; children: ReactNode }) {
  const { live, ask } = useSession();
  const isPaused = useStore(live.playback, (p) => p.phase === 'paused');
  return (
    <div className={styles.note} role="status" data-testid="go-note">
      <div className={styles.words}>
        <strong>{title}</strong>
        <span className="quiet">{children}</span>
      </div>
      {gives ? (
        <Button size="lg" disabled={isPaused} onClick={() => void ask({ do: 'go' })}>
          GO (Enter)
        </Button>
      ) : null}
    </div>
  );
}
