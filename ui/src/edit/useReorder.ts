import { useCallback, useEffect, useRef, useState, type DragEvent, type RefObject } from 'react';
import { listenToHold } from './holdDrag';

/** Reorders items of a list by dragging, with a mouse or with a finger that was held still. */
interface Reorder {
  list: RefObject<HTMLUListElement | null>;
  /** Call when the mouse begins to drag the item at `index`. */
  begin(index: number): void;
  end(): void;
  /** Properties for the item at `index`, so that another can be dropped on it. */
  target(index: number): {
    'data-over': true | undefined;
    onDragOver: (event: DragEvent) => void;
    onDrop: () => void;
  };
}

/** `move` gets the indices of the dragged item and of the one it was dropped on; pass a stable function. */
export function useReorder(move: (from: number, to: number) => void): Reorder {
  const list = useRef<HTMLUListElement>(null);
  const dragged = useRef<number | null>(null);
  const [over, setOver] = useState<number | null>(null);
  const drop = useCallback(
    (to: number) => {
      const from = dragged.current;
      dragged.current = null;
      setOver(null);
      if (from !== null) move(from, to);
    },
    [move],
  );
  const giveUp = useCallback(() => setOver((dragged.current = null)), []);
  useEffect(
    () =>
      list.current
        ? listenToHold(list.current, {
            begin: (index) => setOver((dragged.current = index)),
            over: setOver,
            drop,
            giveUp,
          })
        : undefined,
    [drop, giveUp],
  );
  return {
    list,
    begin: (index) => void (dragged.current = index),
    end: giveUp,
    target: (index) => ({
      'data-over': over === index || undefined,
      onDragOver(event) {
        if (dragged.current === null) return;
        event.preventDefault();
        setOver(index);
      },
      onDrop: () => drop(index),
    }),
  };
}
