import { useHotkeys } from '@mantine/hooks';

/** Fields keep their own keys. */
const FIELDS = ['INPUT', 'TEXTAREA', 'SELECT'];

/** Keys of a view: silent while a dialog is open or somebody types; Space and Enter are left to buttons. */
export function useKeys(keys: readonly (readonly [string, (event: KeyboardEvent) => void])[]) {
  useHotkeys(
    keys.map(([key, act]) => [
      key,
      (event: KeyboardEvent) => {
        if (document.querySelector('[role="dialog"]')) return;
        const target = event.target as HTMLElement | null;
        const button = target?.closest<HTMLElement>('button, [role="tab"], [role="option"]');
        if (button && event.key === ' ') {
          // The key is taken from the button here, so it is given back.
          button.click();
          return;
        }
        act(event);
      },
    ]),
    FIELDS,
  );
}
