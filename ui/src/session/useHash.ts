import { useSyncExternalStore } from 'react';

export type View = 'live' | 'edit' | 'new';

const subscribe = (listener: () => void) => {
  window.addEventListener('hashchange', listener);
  return () => window.removeEventListener('hashchange', listener);
};

/** The view in the address. */
export const viewNow = (): View =>
  location.hash.startsWith('#/edit') ? 'edit' : location.hash.startsWith('#/new') ? 'new' : 'live';

export const useView = (): View => useSyncExternalStore(subscribe, viewNow);

export const goTo = (view: View) => {
  location.hash = `#/${view}`;
};
