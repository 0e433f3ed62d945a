import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** Says that the connection to the server is lost, with a button that tries again at once, or why no broker answers. */
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
