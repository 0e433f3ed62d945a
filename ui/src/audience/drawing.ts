import type { Dot } from '../base/geometry';
import { createLightsCanvas } from '../stage/lightsCanvas';
import { projectionOf, type FloorSize, type Projection, type Viewpoint } from '../stage/projection';
import { viewpointStore } from './viewpoint';

/** What the audience sees at a moment. */
export interface Lights {
  dots: readonly Dot[];
  floor: FloorSize & { radius_m: number };
}

/** The lights at a moment of the page's clock; the same object if nothing changed, so that nothing is drawn. */
export type LightsAt = (now_ms: number) => Lights;

/** Most device pixels per CSS pixel along an axis: soft lights look the same with more. */
const DENSITY_MAX = 2;

/** Draws lights into a canvas at each refresh of the screen if they changed; returns a function that ends this. */
export function drawLights(canvas: HTMLCanvasElement, lightsAt: LightsAt): () => void {
  const picture = createLightsCanvas(canvas);
  let size = { width_px: 1, height_px: 1 };
  let drawn: Lights | null = null;
  let seen: { viewpoint: Viewpoint; floor: FloorSize; projection: Projection } | null = null;
  const observer = new ResizeObserver(([entry]) => {
    if (!entry) return;
    const { width, height } = entry.contentRect;
    size = { width_px: width, height_px: height };
    picture.resize(width, height, Math.min(DENSITY_MAX, window.devicePixelRatio || 1));
    [seen, drawn] = [null, null];
  });
  observer.observe(canvas);
  let request = 0;
  const loop = (now_ms: number) => {
    request = requestAnimationFrame(loop);
    const lights = lightsAt(now_ms);
    const [{ floor }, viewpoint] = [lights, viewpointStore.get()];
    const isSame =
      seen?.viewpoint === viewpoint &&
      seen.floor.width_m === floor.width_m &&
      seen.floor.depth_m === floor.depth_m;
    if (isSame && lights === drawn) return;
    if (!isSame || !seen)
      seen = { viewpoint, floor, projection: projectionOf(viewpoint, floor, size) };
    drawn = lights;
    picture.draw(lights.dots, floor.radius_m, seen.projection);
  };
  request = requestAnimationFrame(loop);
  return () => {
    cancelAnimationFrame(request);
    observer.disconnect();
  };
}
