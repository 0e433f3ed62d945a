import { useHotkeys } from '@mantine/hooks';
import { isFocusByKeyboard } from './focusOrigin';
import { useEscape } from './useEscape';

/** Types of inputs into which no text is typed. */
const WORDLESS = ['radio', 'checkbox', 'button', 'submit', 'file'];
/** Elements that Space presses when the focus came by keyboard. */
const PRESSED = 'button, summary, input, [role="tab"], [role="option"], [role="button"]';

/** The properties of the focused element that matter, so that tests can replace the element. */
export type Focused = Pick<HTMLElement, 'tagName' | 'isContentEditable' | 'closest'> & {
  type?: string;
};

/**
 * Whether a key belongs to the focused element: all keys to text fields and menus, arrows, Home and End to inputs,
 * sliders and tabs. Space belongs to a button only if the focus came by keyboard (`byKeyboard`): after a click it does
 * what the view says. Null: nothing has the focus.
 */
export function isTaken(target: Focused | null, key: string, byKeyboard: boolean): boolean {
  if (!target) return false;
  const { tagName } = target;
  if (tagName === 'TEXTAREA' || tagName === 'SELECT' || target.isContentEditable) return true;
  const input = tagName === 'INPUT' ? (target.type ?? 'text') : null;
  if (input !== null && !WORDLESS.includes(input)) return true;
  if (target.closest('[role="menu"]')) return true;
  if (key === ' ') return byKeyboard && target.closest(PRESSED) !== null;
  const moves = key.startsWith('Arrow') || key === 'Home' || key === 'End';
  return moves && (input !== null || target.closest('[role="slider"], [role="tab"]') !== null);
}

/** Browsers press the focused button when Space is released: this keeps them from it, once. */
function keepFromButton(event: KeyboardEvent) {
  event.target?.addEventListener('keyup', (up) => up.preventDefault(), { once: true });
}

/** Elements that Enter presses or follows. */
const FOLLOWED = `${PRESSED}, a[href]`;

/** Whether the key is an Enter, without Ctrl, that presses the focused button or follows the focused link. */
const isPress = ({ key, ctrlKey, metaKey, target }: KeyboardEvent) =>
  key === 'Enter' && !ctrlKey && !metaKey && (target as HTMLElement | null)?.closest(FOLLOWED);

type Key = readonly [string, (event: KeyboardEvent) => void];

/** `act`, but not for keys that the focused element or an open dialog takes. */
const ruled = (act: Key[1]) => (event: KeyboardEvent) => {
  if (isTaken(event.target as HTMLElement | null, event.key, isFocusByKeyboard())) return;
  if (isPress(event)) return;
  const isOpen = document.querySelector('[role="dialog"]') !== null;
  // In a dialog the focused element gets the keys; browser shortcuts are still blocked.
  if (isOpen && !event.ctrlKey && !event.metaKey) return;
  event.preventDefault();
  if (isOpen) return;
  if (event.key === ' ') {
    keepFromButton(event);
    if (event.repeat) return;
  }
  act(event);
};

/** Keys of a view. They do nothing while a dialog is open or the focused element takes the key. */
export function useKeys(keys: readonly Key[]) {
  const hotkeys = keys.filter(([key]) => key !== 'Escape');
  useHotkeys(
    hotkeys.map(([key, act]) => [key, ruled(act), { preventDefault: false }]),
    [],
  );
  const escape = keys.find(([key]) => key === 'Escape')?.[1];
  useEscape('Escape', escape && ruled(escape));
}
