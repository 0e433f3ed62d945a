import { createStore, useStore, type Store } from '../base/store';
import { isUnit, type Unit } from '../base/units';

/** A choice of this screen, kept in the browser's storage. Without storage it lasts as long as the page. */
export function createChoice<T extends string>(
  key: string,
  usual: T,
  fits: (text: string | null) => text is T,
): Pick<Store<T>, 'get' | 'set' | 'subscribe'> {
  let kept: string | null = null;
  try {
    kept = localStorage.getItem(key);
  } catch {
    // The usual choice.
  }
  const store = createStore<T>(fits(kept) ? kept : usual);
  return {
    ...store,
    set(choice) {
      store.set(choice);
      try {
        localStorage.setItem(key, choice);
      } catch {
        // It lasts as long as the page.
      }
    },
  };
}

/** The unit of lengths on this screen. */
export const unitStore = createChoice<Unit>('lightbots-unit', 'm', isUnit);

export const setUnit = unitStore.set;

export const useUnit = () => useStore(unitStore);
