import type { PointerEvent as ReactPointerEvent } from 'react';

/** What a drag on the timeline does. */
export interface PointerDrag {
  /** The pointer is `by_px` to the right of where it went down, CSS pixels, with what was scrolled meanwhile. */
  move(by_px: number, event: PointerEvent): void;
  end(): void;
  cancel(): void;
}

/** A pointer that stays within this has not dragged, CSS pixels. */
const STILL_PX = 3;
/** A pointer this close to the left or right side of the timeline, or beyond it, scrolls it, CSS pixels. */
const SIDE_PX = 40;
/** Fastest scrolling, CSS pixels at each refresh of the screen. */
const SCROLL_PX = 14;

/** Follows a pointer until it is let go. Escape, or leaving the window for another, cancels. `scroller`: may scroll. */
export function followPointer(
  down: ReactPointerEvent,
  scroller: HTMLElement | null,
  drag: PointerDrag,
) {
  const stop = new AbortController();
  const options = { signal: stop.signal };
  // The drag goes on outside the window, and the browser need not look up what is under the pointer.
  (down.target as Element).setPointerCapture(down.pointerId);
  // Read once: the scroller does not move, nothing else scrolls it meanwhile, and reading costs a layout.
  const box = scroller?.getBoundingClientRect();
  let scrolled_px = 0;
  let [last, request] = [null as PointerEvent | null, 0];
  const move = (event: PointerEvent) =>
    drag.move(event.clientX - down.clientX + scrolled_px, event);
  const leave = () => {
    stop.abort();
    cancelAnimationFrame(request);
  };
  const scroll = () => {
    request = requestAnimationFrame(scroll);
    if (!last || !scroller || !box) return;
    const out = Math.max(0, last.clientX - (box.right - SIDE_PX));
    const before = Math.max(0, box.left + SIDE_PX - last.clientX);
    const by = Math.max(-1, Math.min(1, (out - before) / SIDE_PX)) * SCROLL_PX;
    if (by === 0) return;
    const left = scroller.scrollLeft;
    scroller.scrollLeft += by;
    scrolled_px += scroller.scrollLeft - left;
    if (scroller.scrollLeft !== left) move(last);
  };
  window.addEventListener(
    'pointermove',
    (event) => {
      if (event.pointerId !== down.pointerId) return;
      if (!last && Math.abs(event.clientX - down.clientX) < STILL_PX) return;
      if (!last) request = requestAnimationFrame(scroll);
      last = event;
      move(event);
    },
    options,
  );
  window.addEventListener(
    'pointerup',
    (event) => {
      if (event.pointerId !== down.pointerId) return;
      leave();
      if (last) keepFromClick();
      drag.end();
    },
    options,
  );
  const giveUp = () => {
    leave();
    drag.cancel();
  };
  window.addEventListener(
    'pointercancel',
    (event) => {
      if (event.pointerId === down.pointerId) giveUp();
    },
    options,
  );
  window.addEventListener('blur', giveUp, options);
  window.addEventListener(
    'keydown',
    (event) => {
      if (event.key !== 'Escape' || event.shiftKey) return;
      event.stopPropagation();
      giveUp();
    },
    { ...options, capture: true },
  );
}

/** Keeps the click that follows the end of a drag from everything on the page. */
function keepFromClick() {
  const keep = (event: Event) => event.stopPropagation();
  window.addEventListener('click', keep, { capture: true, once: true });
  setTimeout(() => window.removeEventListener('click', keep, { capture: true }));
}
