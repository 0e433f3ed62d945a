import { useCallback, useEffect, useRef, useState, type DragEvent, type RefObject } from 'react';
import { listenToHold } from './holdDrag';

/** The items of a list that are dragged to other places, by mouse and by a finger that is held. */
interface Reorder {
  list: RefObject<HTMLUListElement | null>;
  /** An item is dragged by mouse. */
  begin(index: number): void;
  end(): void;
  /** Of each item: what is dragged may be dropped on it. */
  target(index: number): {
    'data-over': true | undefined;
    onDragOver: (event: DragEvent) => void;
    onDrop: () => void;
  };
}

/** `move` gets the indices of the item that was dragged and of the one it was dropped on; it must stay the same function. */
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
