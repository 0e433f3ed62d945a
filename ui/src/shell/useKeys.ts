import { useHotkeys } from '@mantine/hooks';

/** Inputs that nobody types into. */
const WORDLESS = ['radio', 'checkbox', 'button', 'submit', 'file'];

/** Whether a key belongs to what has the focus: text to fields, arrows and Space to choices and sliders. */
function isTaken(target: HTMLElement | null, key: string): boolean {
  if (!target) return false;
  const { tagName } = target;
  if (tagName === 'TEXTAREA' || tagName === 'SELECT' || target.isContentEditable) return true;
  const input = tagName === 'INPUT' ? (target as HTMLInputElement).type : null;
  if (input !== null && !WORDLESS.includes(input)) return true;
  const moves = key.startsWith('Arrow') || key === 'Home' || key === 'End';
  if (target.closest('[role="slider"], [role="tab"], [role="menuitem"]')) return moves;
  return input !== null && (moves || key === ' ');
}

/** Keys of a view: silent while a dialog is open or somebody types; Space and Enter are left to buttons. */
export function useKeys(keys: readonly (readonly [string, (event: KeyboardEvent) => void])[]) {
  useHotkeys(
    keys.map(([key, act]) => [
      key,
      (event: KeyboardEvent) => {
        const target = event.target as HTMLElement | null;
        if (isTaken(target, event.key)) return;
        event.preventDefault();
        if (document.querySelector('[role="dialog"]')) return;
        const button = target?.closest<HTMLElement>('button, [role="tab"], [role="option"]');
        if (button && event.key === ' ') {
          // The key is taken from the button here, so it is given back.
          button.click();
          return;
        }
        act(event);
      },
      { preventDefault: false },
    ]),
    [],
  );
}
