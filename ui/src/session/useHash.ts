import { useSyncExternalStore } from 'react';

export type View = 'live' | 'edit';

const subscribe = (listener: () => void) => {
  window.addEventListener('hashchange', listener);
  return () => window.removeEventListener('hashchange', listener);
};

/** The view in the address. */
export const useView = (): View =>
  useSyncExternalStore(subscribe, () => (location.hash.startsWith('#/edit') ? 'edit' : 'live'));

export const goTo = (view: View) => {
  location.hash = `#/${view}`;
};
