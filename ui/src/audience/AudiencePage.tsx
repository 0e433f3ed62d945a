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

/** Closes a window that the live page opened; another one shows the live page. */
function leave() {
  if (window.opener) window.close();
  else goTo('live');
}

/** The page of a projector: the running show as its audience sees it. */
export default function AudiencePage() {
  const { live, ask } = useSession();
  const lightsAt = useMemo(() => createLiveLights(live), [live]);
  const isLost = useStore(live.link) === 'lost';
  const isPlaying = useStore(live.playback, ({ phase }) => isRunning(phase));
  // Whether a show plays is not known without a connection.
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
