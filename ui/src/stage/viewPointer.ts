import type { Point } from '../base/geometry';
import type { Store } from '../base/store';
import { panBy, zoomAt, type Camera } from './camera';
import type { Pans } from './pans';
import { placeOn } from './pointer';
import type { View } from './view';

/**
 * Pans and zooms a view. The wheel zooms, with Shift it pans. The middle button pans, and where `pans` wants it the
 * first button or one finger too. Two fingers pan and zoom, on the screen and on a touchpad.
 */
export function listenToView(canvas: HTMLCanvasElement, view: Store<View>, pans: Pans): () => void {
  const stop = new AbortController();
  const options = { signal: stop.signal };
  const held = new Map<number, Point>();
  /** Ids of the pointers that pan by themselves; another finger only counts together with one of them. */
  const panning = new Set<number>();
  const move = (change: (camera: Camera) => Camera) =>
    view.update((now) => ({ ...now, fitted: false, camera: change(now.camera) }));
  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      const at = { x: event.offsetX, y: event.offsetY };
      move((camera) => turned(camera, at, event));
    },
    { ...options, passive: false },
  );
  canvas.addEventListener(
    'pointerdown',
    (event) => {
      const isFinger = event.pointerType === 'touch';
      const isPan = event.button === 1 || (event.button === 0 && pans.wanted());
      if (!isFinger && !isPan) return;
      event.preventDefault();
      if (isPan) {
        pans.began();
        panning.add(event.pointerId);
      }
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
      else if (panning.has(event.pointerId))
        move((camera) => panBy(camera, at.x - before.x, at.y - before.y));
    },
    options,
  );
  const end = (event: PointerEvent) => {
    held.delete(event.pointerId);
    panning.delete(event.pointerId);
  };
  canvas.addEventListener('pointerup', end, options);
  canvas.addEventListener('pointercancel', end, options);
  return () => stop.abort();
}

/** Exponent of the zoom per CSS pixel of a pinch on a touchpad, which browsers report as a wheel with Ctrl. */
const PINCH = 0.01;
/** Exponent of the zoom per CSS pixel of a wheel. */
const WHEEL = 0.0015;

/** The fields of a wheel event that tell what it means. */
export type Turn = Pick<WheelEvent, 'deltaX' | 'deltaY' | 'deltaMode' | 'ctrlKey' | 'shiftKey'> & {
  wheelDeltaY?: number;
};

/** The camera after a wheel event at `at`, CSS pixels: from a wheel, or from two fingers on a touchpad. */
export function turned(camera: Camera, at: Point, turn: Turn): Camera {
  if (turn.ctrlKey && isTouchpad(turn)) return zoomAt(camera, at, Math.exp(-turn.deltaY * PINCH));
  if (!turn.ctrlKey && (isTouchpad(turn) || turn.deltaX !== 0))
    return panBy(camera, -turn.deltaX, -turn.deltaY);
  if (turn.shiftKey) return panBy(camera, -turn.deltaY, 0);
  return zoomAt(camera, at, Math.exp(-turn.deltaY * WHEEL));
}

/**
 * Whether a wheel event seems to come from a touchpad. Browsers do not say. Some report three units of the old
 * `wheelDeltaY` for each CSS pixel of a touchpad, and 120 for a notch of a wheel.
 */
const isTouchpad = ({ deltaMode, deltaY, wheelDeltaY }: Turn) =>
  deltaMode === 0 && deltaY !== 0 && wheelDeltaY === -3 * deltaY;

/** The camera after one of two fingers went from `before` to `at`, CSS pixels: it zooms and pans with them. */
export function pinch(camera: Camera, before: Point, at: Point, other: Point): Camera {
  const apart = (p: Point) => Math.max(10, Math.hypot(p.x - other.x, p.y - other.y));
  const middle = { x: (before.x + other.x) / 2, y: (before.y + other.y) / 2 };
  const zoomed = zoomAt(camera, middle, apart(at) / apart(before));
  return panBy(zoomed, (at.x - before.x) / 2, (at.y - before.y) / 2);
}
