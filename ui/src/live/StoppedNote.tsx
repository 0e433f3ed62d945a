import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { driveTo } from '../session/drives';
import { startPlay } from '../session/start';
import { useSession } from '../session/session';
import { GotIt, Note } from './Note';

/** A show was stopped: where, and the ways on, above Play, until the operator dismisses it or starts again. */
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

/** Plays the show from the frame in which it was stopped, by the usual checks. */
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
