import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** Tells that the connection to server or broker is lost. The page reconnects by itself; the button does it at once. */
export function LinkBanner() {
  const { live, link } = useSession();
  const state = useStore(live.link);
  const broker = useStore(live.broker);
  if (state === 'lost')
    return (
      <div className="banner" role="alert">
        Connection lost – reconnecting. Robots may still be moving.{' '}
        <Button size="compact-xs" variant="default" onClick={() => link.retry()}>
          Try now
        </Button>
      </div>
    );
  if (state === 'open' && !broker.connected && broker.reason)
    return (
      <div className="banner" role="status">
        No broker: {broker.reason}
      </div>
    );
  return null;
}
