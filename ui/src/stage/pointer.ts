import type { Point } from '../base/geometry';
import type { Store } from '../base/store';
import { panBy, zoomAt, type Camera } from './camera';
import type { View } from './view';

/** Pointer events on the stage, canvas CSS pixels. `adds`: a finger was held still, which is a finger's Shift. */
export interface Hand {
  down(at: Point, event: PointerEvent, adds: boolean): void;
  move(at: Point, event: PointerEvent): void;
  up(at: Point, event: PointerEvent, adds: boolean): void;
  lost(): void;
}

/** A finger held still for this time acts as Shift, milliseconds. */
export const LONG_MS = 450;
/** A finger that stays within this is held still, CSS pixels. */
export const STILL_PX = 8;

/** Position of a pointer on the canvas, CSS pixels. */
function placeOn(canvas: HTMLCanvasElement, event: PointerEvent): Point {
  const box = canvas.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

type Waiting = { from: Point; event: PointerEvent; timer: ReturnType<typeof setTimeout> };

/**
 * The first button or a finger, held until it is let go. What a finger means is known only once it moves, rests or
 * leaves: until then nothing has happened, and a second finger makes it a matter of the view.
 */
export function listenToHand(canvas: HTMLCanvasElement, hand: Hand): () => void {
  const stop = new AbortController();
  let held: number | null = null;
  let waiting: Waiting | null = null;
  let adds = false;
  const on = (
    name: 'pointerdown' | 'pointermove' | 'pointerup' | 'pointercancel',
    act: (event: PointerEvent) => void,
  ) => canvas.addEventListener(name, act, { signal: stop.signal });

  const begin = (isLong: boolean) => {
    if (!waiting) return;
    const { from, event, timer } = waiting;
    clearTimeout(timer);
    [waiting, adds] = [null, isLong];
    hand.down(from, event, isLong);
  };
  const drop = () => {
    if (waiting) clearTimeout(waiting.timer);
    else if (held !== null) hand.lost();
    [waiting, held] = [null, null];
  };

  on('pointerdown', (event) => {
    if (held !== null && event.pointerType === 'touch') return drop();
    if (event.button !== 0 || held !== null || !event.isPrimary) return;
    held = event.pointerId;
    canvas.setPointerCapture(event.pointerId);
    const timer = setTimeout(() => begin(true), LONG_MS);
    waiting = { from: placeOn(canvas, event), event, timer };
    if (event.pointerType !== 'touch') begin(false);
  });
  on('pointermove', (event) => {
    if (held !== null && held !== event.pointerId) return;
    const at = placeOn(canvas, event);
    if (waiting) {
      if (Math.hypot(at.x - waiting.from.x, at.y - waiting.from.y) < STILL_PX) return;
      begin(false);
    }
    hand.move(at, event);
  });
  on('pointerup', (event) => {
    if (held !== event.pointerId) return;
    begin(false);
    held = null;
    hand.up(placeOn(canvas, event), event, adds);
  });
  on('pointercancel', (event) => {
    if (held === event.pointerId) drop();
  });
  return () => {
    if (waiting) clearTimeout(waiting.timer);
    stop.abort();
  };
}

/** Wheel zooms; the middle button (or, if so wanted, the first, or one finger) pans; two fingers do both. */
export function listenToView(
  canvas: HTMLCanvasElement,
  view: Store<View>,
  dragPans: boolean,
): () => void {
  const stop = new AbortController();
  const options = { signal: stop.signal };
  const held = new Map<number, Point>();
  const move = (change: (camera: Camera) => Camera) =>
    view.update((now) => ({ ...now, fitted: false, camera: change(now.camera) }));
  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const at = { x: event.offsetX, y: event.offsetY };
      move((camera) => zoomAt(camera, at, Math.exp(-event.deltaY * 0.0015)));
    },
    { ...options, passive: false },
  );
  canvas.addEventListener(
    'pointerdown',
    (event) => {
      const isFinger = event.pointerType === 'touch';
      if (!isFinger && event.button !== 1 && !(dragPans && event.button === 0)) return;
      event.preventDefault();
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, placeOn(canvas, event));
    },
    options,
  );
  canvas.addEventListener(
    'pointermove',
    (event) => {
      const before = held.get(event.pointerId);
      if (!before) return;
      const at = placeOn(canvas, event);
      held.set(event.pointerId, at);
      const other = [...held].find(([id]) => id !== event.pointerId)?.[1];
      if (other) move((camera) => pinch(camera, before, at, other));
      else if (dragPans || event.pointerType !== 'touch')
        move((camera) => panBy(camera, at.x - before.x, at.y - before.y));
    },
    options,
  );
  const end = (event: PointerEvent) => held.delete(event.pointerId);
  canvas.addEventListener('pointerup', end, options);
  canvas.addEventListener('pointercancel', end, options);
  return () => stop.abort();
}

/** One of two fingers goes from `before` to `at`: what is under both stays under both. */
export function pinch(camera: Camera, before: Point, at: Point, other: Point): Camera {
  const apart = (p: Point) => Math.max(10, Math.hypot(p.x - other.x, p.y - other.y));
  const middle = { x: (before.x + other.x) / 2, y: (before.y + other.y) / 2 };
  const zoomed = zoomAt(camera, middle, apart(at) / apart(before));
  return panBy(zoomed, (at.x - before.x) / 2, (at.y - before.y) / 2);
}
