import { useEffect, useState } from 'react';

/** When the pointer was moved last: within `HIDDEN_MS`, within `AWAY_MS`, or longer ago or not yet. */
export type PointerRest = 'moving' | 'resting' | 'away';

/** After this time without a move, milliseconds, the pointer is `resting`. */
const HIDDEN_MS = 2_000;
/** After this time without a move, milliseconds, the pointer is `away`. */
const AWAY_MS = 5_000;

/** How long ago the pointer was moved or pressed in the window. */
export function usePointerRest(): PointerRest {
  const [rest, setRest] = useState<PointerRest>('away');
  useEffect(() => {
    let timers: ReturnType<typeof setTimeout>[] = [];
    let last: { x: number; y: number } | null = null;
    const clear = () => timers.forEach(clearTimeout);
    const receive = ({ clientX: x, clientY: y, type }: PointerEvent) => {
      // Browsers also report a pointer that stands: when something under it changes, and when a page opens.
      const isMoved = type === 'pointerdown' || (last !== null && (last.x !== x || last.y !== y));
      last = { x, y };
      if (!isMoved) return;
      clear();
      setRest('moving');
      timers = [
        setTimeout(() => setRest('resting'), HIDDEN_MS),
        setTimeout(() => setRest('away'), AWAY_MS),
      ];
    };
    const events = ['pointermove', 'pointerdown'] as const;
    events.forEach((name) => window.addEventListener(name, receive));
    return () => {
      clear();
      events.forEach((name) => window.removeEventListener(name, receive));
    };
  }, []);
  return rest;
}
