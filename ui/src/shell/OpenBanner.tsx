import { useStore } from '../base/store';
import { useSession } from '../session/session';

/** Warns if the server says that the network reaches it without TLS. */
export function OpenBanner() {
  const { live } = useSession();
  const isPlain = useStore(live.hello, (hello) => hello?.plain_http);
  if (!isPlain) return null;
  return (
    <div className="banner" role="status">
      Open to the network without TLS: passwords can be read on the way, and film and MIDI do not
      work. To change that, start LightBots without --plain-http.
    </div>
  );
}
