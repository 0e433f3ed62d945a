import { addressOfView } from '../session/address';
import { notify } from '../session/notices';

/** Opens the audience view in its own window, or brings that window to the front; a notice says if it cannot. */
export function openAudience() {
  const address = location.pathname + addressOfView('audience');
  const opened = window.open(address, 'lightbots-audience', 'popup,width=1280,height=720');
  if (opened) opened.focus();
  else
    notify(
      'error',
      `The browser opened no window. Allow pop-ups for this page, or open ${location.origin}${address} yourself.`,
    );
}
