import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** Says that the server is away. The page tries again by itself; the button is for the impatient. */
export function LinkBanner() {
  const { live, link } = useSession();
  const state = useStore(live.link);
  const broker = useStore(live.broker);
  if (state === 'lost')
    return (
      <div className="banner" role="alert">
        The server does not answer. Trying again by itself; robots go on without this page.{' '}
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
