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
        const button = target?.closest?.('button, [role="tab"], [role="option"], summary');
        if (button && (event.key === ' ' || event.key === 'Enter') && !event.ctrlKey) {
          if (event.key === ' ' || event.key === 'Enter') (target as HTMLButtonElement).click();
          return;
        }
        act(event);
      },
    ]),
    FIELDS,
  );
}
