import type { Dot } from '../base/geometry';
import { canvasFromStage, type Camera } from './camera';
import { createFloorLayer, type FloorPicture } from './floorLayer';
import type { Scene } from './scene';
import { createRasteriser, RASTERISED_MIN } from './rasteriser';
import { addLines } from './lines';
import { createSprites, isOff } from './sprites';
import { FLOOR } from './palette';

/** Draws scenes on a canvas. Sizes are CSS pixels; `density`: device pixels per CSS pixel. */
export interface StageRenderer {
  resize(width_px: number, height_px: number, density: number): void;
  draw(scene: Scene, camera: Camera): void;
}

export function createCanvas2d(element: HTMLCanvasElement): StageRenderer {
  const context = element.getContext('2d', { alpha: false });
  if (!context) throw new Error('This browser cannot draw: it gives no 2D canvas.');
  const sprites = createSprites();
  const rasteriser = createRasteriser();
  const floor = createFloorLayer(rasteriser);
  let frame: ImageData | null = null;
  let density = 1;

  /** Copies one sprite per dot; a dot without a sprite is left out. */
  const copy = (
    dots: readonly Dot[],
    camera: Camera,
    sprite: (dot: Dot) => ImageBitmap | null,
    alpha: (dot: Dot) => number,
  ) => {
    for (const dot of dots) {
      const picture = sprite(dot);
      if (!picture) continue;
      context.globalAlpha = alpha(dot);
      context.drawImage(
        picture,
        (camera.originX_px + dot.x * camera.scale) * density - picture.width / 2,
        (camera.originY_px - dot.y * camera.scale) * density - picture.height / 2,
      );
    }
    context.globalAlpha = 1;
  };

  const drawFew = (dots: readonly Dot[], radius_px: number, camera: Camera) => {
    const body = sprites.body(radius_px);
    copy(
      dots,
      camera,
      () => body,
      (dot) => 0.35 + 0.65 * dot.alpha,
    );
    context.globalCompositeOperation = 'lighter';
    copy(
      dots,
      camera,
      (dot) => sprites.glow(dot.color, radius_px),
      (dot) => dot.alpha,
    );
    context.globalCompositeOperation = 'source-over';
  };

  const drawMany = (scene: Scene, radius_px: number, camera: Camera, { pixels }: FloorPicture) => {
    const { width, height } = element;
    if (frame?.width !== width || frame.height !== height) frame = new ImageData(width, height);
    frame.data.set(pixels.data);
    const dark = scene.filled.filter((dot) => isOff(dot.color));
    rasteriser.layBodies(frame, dark, radius_px, camera, density);
    rasteriser.addLights(frame, scene.filled, radius_px, camera, density);
    addLines(frame, scene.errors, camera, density);
    context.putImageData(frame, 0, 0);
  };

  return {
    resize(width_px, height_px, nextDensity) {
      density = nextDensity;
      element.width = Math.max(1, Math.round(width_px * density));
      element.height = Math.max(1, Math.round(height_px * density));
    },
    draw(scene, camera) {
      context.setTransform(1, 0, 0, 1, 0, 0);
      const picture = floor.of(scene, camera, element, density);
      const radius_px = Math.max(1.2, scene.radius_m * camera.scale) * density;
      if (scene.filled.length >= RASTERISED_MIN) drawMany(scene, radius_px, camera, picture);
      else {
        context.drawImage(picture.canvas(), 0, 0);
        drawFew(scene.filled, radius_px, camera);
      }
      context.setTransform(density, 0, 0, density, 0, 0);
      if (scene.filled.length < RASTERISED_MIN) drawErrors(context, scene, camera);
      scene.overlay?.(context, camera);
    },
  };
}

function drawErrors(context: CanvasRenderingContext2D, scene: Scene, camera: Camera) {
  if (scene.errors.length === 0) return;
  context.strokeStyle = FLOOR.box;
  context.lineWidth = 1;
  context.setLineDash([3, 3]);
  context.beginPath();
  for (const [from, to] of scene.errors) {
    const [a, b] = [canvasFromStage(camera, from), canvasFromStage(camera, to)];
    context.moveTo(a.x, a.y);
    context.lineTo(b.x, b.y);
  }
  context.stroke();
  context.setLineDash([]);
}
