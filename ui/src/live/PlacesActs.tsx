import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { useWhyNot } from '../parts/Gate';
import { changeShow } from '../session/changeShow';
import { driveTo } from '../session/drives';
import { withStarts, type placedRobots } from '../session/places';
import { useSession } from '../session/session';

interface TakeProps {
  robots: ReturnType<typeof placedRobots>;
  /** Number of starting places of the show; `Infinity` while it is not known. */
  places: number;
  onClose: () => void;
}

/** A button that makes the places where robots stand the starting places of the show, once all places are known. */
export function TakeLayout({ robots: [placed, unknown], places, onClose }: TakeProps) {
  const session = useSession();
  const readOnly = useStore(session.live.opened, (o) => o.readOnly);
  const reason = useWhyNot('editor', 'change the show');
  const isComplete = placed.length >= places && unknown.length === 0;
  const missing = isComplete ? undefined : 'All robots of the show have to say where they stand.';
  return (
    <Button
      variant="default"
      disabled={!isComplete || readOnly !== null || reason !== null}
      title={reason ?? missing}
      onClick={() => {
        onClose();
        void changeShow(session, 'Starting places', (now) => withStarts(now, placed));
      }}
    >
      Take this layout
    </Button>
  );
}

/** A button that drives robots to the starting places; `isNeeded`: whether a robot stands elsewhere. */
export function DriveHome({ isNeeded, onClose }: { isNeeded: boolean; onClose: () => void }) {
  const session = useSession();
  const isReady = useStore(session.live.playback, (p) => p.phase === 'ready');
  const reason = useWhyNot('operator', 'drive robots');
  return (
    <Button
      disabled={!isReady || !isNeeded || reason !== null}
      title={reason ?? undefined}
      onClick={() => {
        onClose();
        driveTo(session, 'home');
      }}
    >
      Home
    </Button>
  );
}
