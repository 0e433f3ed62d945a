import { useHotkeys } from '@mantine/hooks';
import { isFocusByKeyboard } from './focusOrigin';
import { useEscape } from './useEscape';

/** Inputs that nobody types into. */
const WORDLESS = ['radio', 'checkbox', 'button', 'submit', 'file'];
/** What Space works on, if the focus came there by keyboard. */
const PRESSED = 'button, summary, input, [role="tab"], [role="option"], [role="button"]';

/** What of an element with the focus is looked at, so that tests can stand in for it. */
export type Focused = Pick<HTMLElement, 'tagName' | 'isContentEditable' | 'closest'> & {
  type?: string;
};

/**
 * Whether a key belongs to what has the focus: text to fields, arrows to choices and sliders. Space presses a button only
 * where the focus ring shows: after a click it does what the view says, and does not repeat the click.
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

/** Browsers press a button when Space is let go: not where the view has taken the key. */
function keepFromButton(event: KeyboardEvent) {
  event.target?.addEventListener('keyup', (up) => up.preventDefault(), { once: true });
}

type Key = readonly [string, (event: KeyboardEvent) => void];

/** What a key does in a view, unless something else has it. */
const ruled = (act: Key[1]) => (event: KeyboardEvent) => {
  if (isTaken(event.target as HTMLElement | null, event.key, isFocusByKeyboard())) return;
  const isOpen = document.querySelector('[role="dialog"]') !== null;
  // What has the focus in a dialog gets its keys; the browser's own shortcuts stay out all the same.
  if (isOpen && !event.ctrlKey && !event.metaKey) return;
  event.preventDefault();
  if (isOpen) return;
  if (event.key === ' ') {
    keepFromButton(event);
    if (event.repeat) return;
  }
  act(event);
};

/** Keys of a view: silent while a dialog is open or a text field has the focus. */
export function useKeys(keys: readonly Key[]) {
  const hotkeys = keys.filter(([key]) => key !== 'Escape');
  useHotkeys(
    hotkeys.map(([key, act]) => [key, ruled(act), { preventDefault: false }]),
    [],
  );
  const escape = keys.find(([key]) => key === 'Escape')?.[1];
  useEscape('Escape', escape && ruled(escape));
}
