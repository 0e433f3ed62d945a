import { createStore, useStore } from '../base/store';
import { isUnit, type Unit } from '../base/units';

const KEY = 'lightbots-unit';

function stored(): Unit {
  try {
    const unit = localStorage.getItem(KEY);
    return isUnit(unit) ? unit : 'm';
  } catch {
    return 'm';
  }
}

/** The unit of lengths on this screen. */
export const unitStore = createStore<Unit>(stored());

export function setUnit(unit: Unit) {
  unitStore.set(unit);
  try {
    localStorage.setItem(KEY, unit);
  } catch {
    // Without storage the unit lasts as long as the page.
  }
}

export const useUnit = () => useStore(unitStore);
