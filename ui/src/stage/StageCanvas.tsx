import { useEffect, useRef } from 'react';
import type { Store } from '../base/store';
import { fit, type Camera } from './camera';
import { createCanvas2d } from './canvas2d';
import type { Pans } from './pans';
import { listenToHand, type Hand } from './pointer';
import type { Scene } from './scene';
import type { View } from './view';
import { listenToView } from './viewPointer';

/** Room on all sides of the floor for rulers, CSS pixels. */
const MARGIN_PX = 34;
/** Further room above the floor for the tools, CSS pixels. */
const TOOLS_PX = 20;

interface Props {
  view: Store<View>;
  /** The scene at a moment; the same object when nothing changed, so that nothing is drawn. */
  sceneAt: (now_ms: number) => Scene;
  /** Whether a drag with the first button pans. */
  pans: Pans;
  /** Handles pointers that do not pan. */
  hand?: Hand;
}

/** A canvas that draws a scene at each refresh of the screen if it changed, and pans and zooms by pointer and wheel. */
export function StageCanvas({ view, sceneAt, pans, hand }: Props) {
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
    const undo = listenToView(canvas, view, pans);
    const undoHand = hand ? listenToHand(canvas, hand, pans) : undefined;
    return () => {
      cancelAnimationFrame(request);
      observer.disconnect();
      undo();
      undoHand?.();
    };
  }, [view, sceneAt, pans, hand]);
  return <canvas ref={element} aria-hidden />;
}

function refit(view: Store<View>, scene: Scene) {
  const now = view.get();
  if (!now.fitted) return;
  const camera = fit(scene.width_m, scene.depth_m, now, MARGIN_PX, TOOLS_PX);
  const same = (['scale', 'originX_px', 'originY_px'] as const).every(
    (key) => camera[key] === now.camera[key],
  );
  if (!same) view.set({ ...now, camera });
}
