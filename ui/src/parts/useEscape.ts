import { getHotkeyHandler } from '@mantine/hooks';
import { useEffect } from 'react';

/**
 * Does it on Escape, or on Shift and Escape, before anything else hears the key: a tip that is shown takes every Escape
 * for itself.
 */
export function useEscape(key: 'Escape' | 'shift+Escape', act?: (event: KeyboardEvent) => void) {
  useEffect(() => {
    if (!act) return;
    const receive = getHotkeyHandler([[key, act as () => void, { preventDefault: false }]]);
    window.addEventListener('keydown', receive, { capture: true });
    return () => window.removeEventListener('keydown', receive, { capture: true });
  }, [key, act]);
}
