import type { Point } from '../base/geometry';
import type { Pans } from './pans';

/**
 * Pointer events on the stage, canvas CSS pixels. `adds`: a finger was held still for `LONG_MS`, which acts as Shift.
 * `lost`: what `down` began is over without `up`.
 */
export interface Hand {
  down(at: Point, event: PointerEvent, adds: boolean): void;
  move(at: Point, event: PointerEvent): void;
  up(at: Point, event: PointerEvent, adds: boolean): void;
  lost(): void;
  /** The second button, or a finger held still and lifted in place, asks for a menu. What `down` began is over. */
  menu(at: Point, event: MouseEvent): void;
}

/** A finger held still for this time acts as Shift, milliseconds; larger: it must be held longer. */
export const LONG_MS = 450;
/** A finger that stays within this is held still, CSS pixels. */
export const STILL_PX = 8;

/** Position of a pointer on the canvas, CSS pixels. */
export function placeOn(canvas: HTMLCanvasElement, event: MouseEvent): Point {
  const box = canvas.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

const isStill = (a: Point, b: Point) => Math.hypot(a.x - b.x, a.y - b.y) < STILL_PX;

type Waiting = { from: Point; event: PointerEvent; timer: ReturnType<typeof setTimeout> };

/**
 * Tells `hand` of the first button or a finger, and of moves without a button. A finger's `down` waits until the
 * finger moves, has rested for `LONG_MS` or is lifted. A second finger ends what the first one does.
 */
export function listenToHand(canvas: HTMLCanvasElement, hand: Hand, pans: Pans): () => void {
  const stop = new AbortController();
  let held: number | null = null;
  let isFinger = false;
  let waiting: Waiting | null = null;
  let adds = false;
  /** Where a finger rests that was held still for `LONG_MS` and has not moved since; null: none. */
  let resting: Point | null = null;
  const on = (
    name: 'pointerdown' | 'pointermove' | 'pointerup' | 'pointercancel',
    act: (event: PointerEvent) => void,
  ) => canvas.addEventListener(name, act, { signal: stop.signal });

  const begin = (isLong: boolean) => {
    if (!waiting) return;
    const { from, event, timer } = waiting;
    clearTimeout(timer);
    [waiting, adds, resting] = [null, isLong, isLong ? from : null];
    hand.down(from, event, isLong);
  };
  const drop = () => {
    if (waiting) clearTimeout(waiting.timer);
    else if (held !== null) hand.lost();
    [waiting, held, resting] = [null, null, null];
  };

  on('pointerdown', (event) => {
    if (held !== null && event.pointerType === 'touch') return drop();
    if (event.button !== 0 || held !== null || !event.isPrimary || pans.wanted()) return;
    held = event.pointerId;
    isFinger = event.pointerType === 'touch';
    canvas.setPointerCapture(event.pointerId);
    const timer = setTimeout(() => begin(true), LONG_MS);
    waiting = { from: placeOn(canvas, event), event, timer };
    if (event.pointerType !== 'touch') begin(false);
  });
  on('pointermove', (event) => {
    if (held !== null && held !== event.pointerId) return;
    const at = placeOn(canvas, event);
    if (waiting) {
      if (isStill(at, waiting.from)) return;
      begin(false);
    }
    if (resting && isStill(at, resting)) return;
    resting = null;
    hand.move(at, event);
  });
  on('pointerup', (event) => {
    if (held !== event.pointerId) return;
    begin(false);
    held = null;
    if (resting) hand.menu(placeOn(canvas, event), event);
    else hand.up(placeOn(canvas, event), event, adds);
    resting = null;
  });
  on('pointercancel', (event) => {
    if (held === event.pointerId) drop();
  });
  canvas.addEventListener(
    'contextmenu',
    (event) => {
      event.preventDefault();
      // A finger that is held still asks for a menu too, and gets one when it is lifted.
      if (held !== null && isFinger) return;
      drop();
      hand.menu(placeOn(canvas, event), event);
    },
    { signal: stop.signal },
  );
  return () => {
    if (waiting) clearTimeout(waiting.timer);
    stop.abort();
  };
}
