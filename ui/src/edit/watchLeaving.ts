import type { Keeper } from '../model/drafts';
import type { Saver } from '../model/saver';

/**
 * Writes the draft when the page is hidden or closed, and asks before the page closes if the draft did not fit into
 * the storage. Writes unsaved changes again when the page comes back, or when another page removed the draft. Returns
 * a function that ends this.
 */
export function watchLeaving({ keeper, saver }: { keeper: Keeper; saver: Saver }): () => void {
  const stop = new AbortController();
  const options = { signal: stop.signal };
  window.addEventListener(
    'pagehide',
    () => {
      keeper.leave();
      saver.flush();
    },
    options,
  );
  window.addEventListener('pageshow', () => keeper.hold(), options);
  window.addEventListener(
    'beforeunload',
    (event) => {
      keeper.flush();
      if (keeper.isEndangered()) event.preventDefault();
    },
    options,
  );
  window.addEventListener(
    'storage',
    ({ key, newValue }) => {
      if (newValue === null && (key === null || keeper.isKeptAs(key))) keeper.hold();
    },
    options,
  );
  document.addEventListener(
    'visibilitychange',
    () => {
      if (document.visibilityState !== 'hidden') return;
      keeper.flush();
      saver.flush();
    },
    options,
  );
  return () => stop.abort();
}
