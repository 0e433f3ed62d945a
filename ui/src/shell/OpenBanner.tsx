import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** Warns while the server is open to the network. */
export function OpenBanner() {
  const { live } = useSession();
  const isOpen = useStore(live.hello, (hello) => hello?.open_to_network);
  if (!isOpen) return null;
  return (
    <div className="banner" role="status">
      Open to the network without TLS: passwords can be read on the way. To close it, start
      LightBots without --open-to-network.
    </div>
  );
}
