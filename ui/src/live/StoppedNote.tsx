import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { driveTo } from '../session/drives';
import { startPlay } from '../session/start';
import { useSession } from '../session/session';
import { GotIt, Note } from './Note';

/** After a show was stopped without a failure: in which frame, with buttons to play on, drive home, or dismiss it. */
export function StoppedNote() {
  const session = useSession();
  const { live } = session;
  const stopped = useStore(live.playback, (p) => (p.failure === null ? p.stopped_in : null));
  const isReady = useStore(live.playback, (p) => p.phase === 'ready');
  if (stopped === null) return null;
  return (
    <Note tone="stopped" text={`Stopped in frame ${stopped + 1}. Robots stand where they were.`}>
      <PlayOn from={stopped} />
      <Button
        size="compact-sm"
        variant="default"
        disabled={!isReady}
        onClick={() => driveTo(session, 'home')}
      >
        Home
      </Button>
      <GotIt />
    </Note>
  );
}

/** A button that plays the show from frame `from`, counted from 0, after the usual checks. */
export function PlayOn({ from }: { from: number }) {
  const session = useSession();
  const isReady = useStore(session.live.playback, (p) => p.phase === 'ready');
  return (
    <Button
      size="compact-sm"
      disabled={!isReady}
      onClick={() => {
        session.frame.set(from);
        startPlay(session);
      }}
    >
      Play on from frame {from + 1}
    </Button>
  );
}
