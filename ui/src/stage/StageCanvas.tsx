import { useEffect, useRef } from 'react';
import { createStore, type Store } from '../base/store';
import { fit, panBy, zoomAt, type Camera } from './camera';
import { createCanvas2d } from './canvas2d';
import type { Scene } from './scene';

/** Camera of a stage and whether it follows the size of its place on screen. */
export interface View {
  camera: Camera;
  fitted: boolean;
  width_px: number;
  height_px: number;
}

export const createView = (): Store<View> =>
  createStore<View>({
    camera: { scale: 200, originX_px: 0, originY_px: 0 },
    fitted: true,
    width_px: 1,
    height_px: 1,
  });

interface Props {
  view: Store<View>;
  /** The scene at a moment; the same object when nothing changed, so that nothing is drawn. */
  sceneAt: (now_ms: number) => Scene;
  /** Whether dragging with the first button pans, as where nothing can be chosen. */
  dragPans: boolean;
}

/** A canvas that draws a scene at the pace of the screen, zooms with the wheel and pans. */
export function StageCanvas({ view, sceneAt, dragPans }: Props) {
  const element = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const canvas = element.current;
    if (!canvas) return;
    const renderer = createCanvas2d(canvas);
    let [scene, camera, request] = [null as Scene | null, null as Camera | null, 0];
    const observer = new ResizeObserver(([entry]) => {
      if (!entry) return;
      const { width, height } = entry.contentRect;
      renderer.resize(width, height, Math.min(2, window.devicePixelRatio || 1));
      view.update((now) => ({ ...now, width_px: width, height_px: height }));
      scene = null;
    });
    observer.observe(canvas);
    const loop = (now_ms: number) => {
      request = requestAnimationFrame(loop);
      const next = sceneAt(now_ms);
      refit(view, next);
      const wanted = view.get().camera;
      if (next === scene && wanted === camera) return;
      [scene, camera] = [next, wanted];
      renderer.draw(next, wanted);
    };
    request = requestAnimationFrame(loop);
    const undo = listen(canvas, view, dragPans);
    return () => {
      cancelAnimationFrame(request);
      observer.disconnect();
      undo();
    };
  }, [view, sceneAt, dragPans]);
  return <canvas ref={element} aria-hidden />;
}

function refit(view: Store<View>, scene: Scene) {
  const now = view.get();
  if (!now.fitted) return;
  const camera = fit(scene.width_m, scene.depth_m, now);
  const same = (['scale', 'originX_px', 'originY_px'] as const).every(
    (key) => camera[key] === now.camera[key],
  );
  if (!same) view.set({ ...now, camera });
}

/** Wheel and pinch zoom, middle button (or, if so wanted, the first) pans. */
function listen(canvas: HTMLCanvasElement, view: Store<View>, dragPans: boolean): () => void {
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
