import { useSyncExternalStore } from 'react';

export type View = 'live' | 'edit' | 'new' | 'audience' | 'shared';

/** Beginning of an address that contains a whole show; the packed show follows it. */
const SHARED = '#/shared/';

/** Views by the beginning of their address; every other address is the live view's. */
const VIEWS: readonly (readonly [start: string, view: View])[] = [
  ['#/edit', 'edit'],
  ['#/new', 'new'],
  ['#/audience', 'audience'],
  [SHARED, 'shared'],
];

/** The address of the editor; the name of the show that it edits may follow. */
const EDIT = '#/edit';

/** Called at once when this page changes the address. The browser's `hashchange` event calls them too, but later. */
const listeners = new Set<() => void>();

const subscribe = (listener: () => void) => {
  listeners.add(listener);
  window.addEventListener('hashchange', listener);
  return () => {
    listeners.delete(listener);
    window.removeEventListener('hashchange', listener);
  };
};

function change(address: string) {
  location.hash = address;
  for (const listener of [...listeners]) listener();
}

/** The view in the address. */
export const viewNow = (): View =>
  VIEWS.find(([start]) => location.hash.startsWith(start))?.[1] ?? 'live';

export const useView = (): View => useSyncExternalStore(subscribe, viewNow);

/** The address of a view. */
export const addressOfView = (view: View) => `#/${view}`;

export const goTo = (view: View) => change(addressOfView(view));

/** Name of the show that follows `#/edit/` in the address; null: none. */
export function showInAddress(): string | null {
  const path = location.hash.startsWith(`${EDIT}/`) ? location.hash.slice(EDIT.length + 1) : '';
  if (path === '') return null;
  try {
    return decodeURIComponent(path);
  } catch {
    // A percent sign that escapes nothing: the name as it is written.
    return path;
  }
}

/** The address of the editor of a show. */
export const addressOf = (show: string) => `${EDIT}/${encodeURIComponent(show)}`;

/** Writes the editor's address of a show over the current entry of the browser's history. Calls no listener. */
export const nameInAddress = (show: string) => history.replaceState(null, '', addressOf(show));

/** Calls the listener when the address changes, but not for `nameInAddress`; returns a function that ends this. */
export const followAddress = subscribe;

/** Goes to the editor of a show, on this screen only. */
export const editShow = (name: string) => change(addressOf(name));

/** The address on this server that contains a packed show. */
export const sharedAddress = (packed: string) =>
  `${location.origin}${location.pathname}${SHARED}${packed}`;

const sharedNow = () =>
  location.hash.startsWith(SHARED) ? location.hash.slice(SHARED.length) : '';

/** The packed show in the address; empty: there is none. */
export const useShared = (): string => useSyncExternalStore(subscribe, sharedNow);
