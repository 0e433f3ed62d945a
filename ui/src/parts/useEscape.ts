import { getHotkeyHandler } from '@mantine/hooks';
import { useEffect } from 'react';

/**
 * Calls `act` on Escape, or on Shift and Escape, before elements of the page hear the key. A tooltip that is shown
 * would take the key for itself. Without `act` nothing happens.
 */
export function useEscape(key: 'Escape' | 'shift+Escape', act?: (event: KeyboardEvent) => void) {
  useEffect(() => {
    if (!act) return;
    const receive = getHotkeyHandler([[key, act as () => void, { preventDefault: false }]]);
    window.addEventListener('keydown', receive, { capture: true });
    return () => window.removeEventListener('keydown', receive, { capture: true });
  }, [key, act]);
}
