import { LONG_MS, STILL_PX } from '../stage/pointer';

/** Called while a finger drags an item of a list; arguments are indices of items. */
export interface HoldDrag {
  begin(index: number): void;
  over(index: number): void;
  /** The finger was lifted over the item with this index. */
  drop(index: number): void;
  giveUp(): void;
}

/** A dragging finger this near to an end of the list, or beyond it, scrolls the list, CSS pixels. */
const EDGE_PX = 48;
/** Step by which the list scrolls, CSS pixels. */
const SCROLL_PX = 12;
/** Time between two such steps, milliseconds. */
const SCROLL_EVERY_MS = 30;

/**
 * Lets a finger that was held still for `LONG_MS` on an item (`li`) of a horizontal list drag the item. A finger that
 * moves sooner scrolls the list. Returns a function that ends this.
 */
export function listenToHold(list: HTMLElement, drag: HoldDrag): () => void {
  const stop = new AbortController();
  const options = { signal: stop.signal };
  let waiting: { x: number; y: number; timer: ReturnType<typeof setTimeout> } | null = null;
  let held: HTMLElement | null = null;
  let [x, scroll] = [0, undefined as ReturnType<typeof setInterval> | undefined];

  const itemAt = (atX: number, atY: number) => {
    const item = document.elementFromPoint(atX, atY)?.closest('li');
    return item?.parentElement === list ? item : null;
  };
  const indexOf = (item: Element | null) => (item ? [...list.children].indexOf(item) : -1);
  const forget = () => {
    clearTimeout(waiting?.timer);
    waiting = null;
  };
  const letGo = () => {
    clearInterval(scroll);
    held?.removeAttribute('data-held');
    held = null;
  };
  const scrollAtEnds = () => {
    const box = list.getBoundingClientRect();
    if (x < box.left + EDGE_PX) list.scrollLeft -= SCROLL_PX;
    if (x > box.right - EDGE_PX) list.scrollLeft += SCROLL_PX;
  };
  const take = (item: HTMLElement) => {
    waiting = null;
    held = item;
    item.setAttribute('data-held', '');
    scroll = setInterval(scrollAtEnds, SCROLL_EVERY_MS);
    drag.begin(indexOf(item));
  };

  list.addEventListener(
    'touchstart',
    (event) => {
      forget();
      const [touch] = event.touches;
      if (!touch || event.touches.length > 1) {
        if (held) drag.giveUp();
        return letGo();
      }
      const item = itemAt(touch.clientX, touch.clientY);
      if (!item) return;
      x = touch.clientX;
      const timer = setTimeout(() => take(item), LONG_MS);
      waiting = { x: touch.clientX, y: touch.clientY, timer };
    },
    { ...options, passive: true },
  );
  list.addEventListener(
    'touchmove',
    (event) => {
      const [touch] = event.touches;
      if (!touch) return;
      if (waiting && Math.hypot(touch.clientX - waiting.x, touch.clientY - waiting.y) > STILL_PX)
        forget();
      if (!held) return;
      // The item moves now, not the list.
      event.preventDefault();
      x = touch.clientX;
      const over = indexOf(itemAt(touch.clientX, touch.clientY));
      if (over >= 0) drag.over(over);
    },
    { ...options, passive: false },
  );
  list.addEventListener(
    'touchend',
    (event) => {
      forget();
      if (!held) return;
      // A dragged item is not also clicked.
      event.preventDefault();
      letGo();
      const [touch] = event.changedTouches;
      const over = touch ? indexOf(itemAt(touch.clientX, touch.clientY)) : -1;
      if (over >= 0) drag.drop(over);
      else drag.giveUp();
    },
    options,
  );
  list.addEventListener(
    'touchcancel',
    () => {
      forget();
      if (held) drag.giveUp();
      letGo();
    },
    options,
  );
  // A finger held still makes the browser open a menu or begin its own dragging: neither is wanted.
  for (const name of ['contextmenu', 'dragstart'] as const)
    list.addEventListener(
      name,
      (event) => {
        if (waiting || held) event.preventDefault();
      },
      { ...options, capture: true },
    );
  return () => {
    forget();
    letGo();
    stop.abort();
  };
}
