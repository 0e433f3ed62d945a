import { useCallback, useMemo } from 'react';
import { useStore } from '../base/store';
import { useEscape } from '../parts/useEscape';
import { goTo } from '../session/address';
import { isRunning } from '../session/phases';
import { useSession } from '../session/session';
import { AudienceScreen } from './AudienceScreen';
import { createLiveLights } from './liveLights';
import { useWakeLock } from './useWakeLock';
import styles from './Audience.module.css';

/** Closes a window that another page opened; any other window goes to the live view. */
function leave() {
  if (window.opener) window.close();
  else goTo('live');
}

/** The audience view: the measured lights of the robots as an audience sees them. */
export default function AudiencePage() {
  const { live, ask } = useSession();
  const lightsAt = useMemo(() => createLiveLights(live), [live]);
  const isLost = useStore(live.link) === 'lost';
  const isPlaying = useStore(live.playback, ({ phase }) => isRunning(phase));
  // Without a connection it is not known whether a show plays: the screen stays on.
  useWakeLock(isPlaying || isLost);
  useEscape(
    'shift+Escape',
    useCallback(() => void ask({ do: 'stop_all' }), [ask]),
  );
  return (
    <AudienceScreen role="main" lightsAt={lightsAt} onBack={leave}>
      {isLost ? (
        <span className={styles.lost} role="status" data-testid="lost">
          <span className="hidden-text">Connection lost – reconnecting.</span>
        </span>
      ) : null}
    </AudienceScreen>
  );
}
