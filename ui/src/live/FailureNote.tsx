import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { GotIt, Note } from './Note';
import { PlayOn } from './StoppedNote';

/** The server's text about the last failure, and if the show stopped in a frame a button that plays on from it. */
export function FailureNote() {
  const { live } = useSession();
  const failure = useStore(live.playback, (p) => p.failure);
  const stopped = useStore(live.playback, (p) => p.stopped_in);
  if (failure === null) return null;
  return (
    <Note tone="bad" text={failure}>
      {stopped === null ? null : <PlayOn from={stopped} />}
      <GotIt />
    </Note>
  );
}
