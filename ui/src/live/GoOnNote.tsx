import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { asksToGoOn } from './actions';
import { Note } from './Note';

/** Shown while an interrupted show waits: buttons let it go on or stop it. */
export function GoOnNote() {
  const { live, ask } = useSession();
  const asks = useStore(live.playback, asksToGoOn);
  if (!asks) return null;
  return (
    <Note
      tone="bad"
      text="The show was interrupted, and its robots report again. Look at the floor before it goes on."
    >
      <Button size="compact-sm" onClick={() => void ask({ do: 'go_on' })}>
        Go on
      </Button>
      <Button size="compact-sm" variant="default" onClick={() => void ask({ do: 'abort' })}>
        Stop
      </Button>
    </Note>
  );
}
