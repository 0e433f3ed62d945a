import { useEffect, useState } from 'react';

/** How the pointer was moved last: just now, a while ago, or long ago. */
export type PointerRest = 'moving' | 'resting' | 'away';

/** A pointer that has not been moved for this long is hidden, milliseconds. */
const HIDDEN_MS = 2_000;
/** What is shown after a move goes away after this long, milliseconds. */
const AWAY_MS = 5_000;

/** Follows the pointer in the window. */
export function usePointerRest(): PointerRest {
  const [rest, setRest] = useState<PointerRest>('away');
  useEffect(() => {
    let timers: ReturnType<typeof setTimeout>[] = [];
    let last: { x: number; y: number } | null = null;
    const clear = () => timers.forEach(clearTimeout);
    const receive = ({ clientX: x, clientY: y, type }: PointerEvent) => {
      // Browsers report a pointer that stands when something under it changes, and where it is when a page opens.
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
