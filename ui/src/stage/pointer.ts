import type { Store } from '../base/store';
import { panBy, zoomAt, type Camera, type Point } from './camera';
import type { View } from './view';

/** Pointer events on the stage, canvas CSS pixels. */
export interface Hand {
  down(at: Point, event: PointerEvent): void;
  move(at: Point, event: PointerEvent): void;
  up(at: Point, event: PointerEvent): void;
  lost(): void;
}

/** The first button or a finger, held until it is let go. */
export function listenToHand(canvas: HTMLCanvasElement, hand: Hand): () => void {
  const stop = new AbortController();
  let held: number | null = null;
  const at = (event: PointerEvent): Point => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const on = (
    name: 'pointerdown' | 'pointermove' | 'pointerup' | 'pointercancel',
    act: (event: PointerEvent) => void,
  ) => canvas.addEventListener(name, act, { signal: stop.signal });
  on('pointerdown', (event) => {
    if (event.button !== 0 || held !== null) return;
    held = event.pointerId;
    canvas.setPointerCapture(event.pointerId);
    hand.down(at(event), event);
  });
  on('pointermove', (event) => {
    if (held === null || held === event.pointerId) hand.move(at(event), event);
  });
  on('pointerup', (event) => {
    if (held !== event.pointerId) return;
    held = null;
    hand.up(at(event), event);
  });
  on('pointercancel', (event) => {
    if (held !== event.pointerId) return;
    held = null;
    hand.lost();
  });
  return () => stop.abort();
}

/** Wheel and pinch zoom, middle button (or, if so wanted, the first) pans. */
export function listenToView(
  canvas: HTMLCanvasElement,
  view: Store<View>,
  dragPans: boolean,
): () => void {
  const stop = new AbortController();
  const options = { signal: stop.signal };
  let last: { x: number; y: number } | null = null;
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
      if (event.button !== 1 && !(dragPans && event.button === 0)) return;
      event.preventDefault();
      canvas.setPointerCapture(event.pointerId);
      last = { x: event.clientX, y: event.clientY };
    },
    options,
  );
  canvas.addEventListener(
    'pointermove',
    (event) => {
      if (!last) return;
      const [dx, dy] = [event.clientX - last.x, event.clientY - last.y];
      last = { x: event.clientX, y: event.clientY };
      if (dx !== 0 || dy !== 0) move((camera) => panBy(camera, dx, dy));
    },
    options,
  );
  const end = () => (last = null);
  canvas.addEventListener('pointerup', end, options);
  canvas.addEventListener('pointercancel', end, options);
  return () => stop.abort();
}
