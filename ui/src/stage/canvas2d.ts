import { canvasFromStage, type Camera } from './camera';
import { createFloorLayer } from './floorLayer';
import type { Dot, Scene } from './scene';
import { createSprites } from './sprites';

/** Draws scenes. Canvas2D is the only one there is; another (WebGL) would stand behind the same two calls. */
export interface StageRenderer {
  resize(width_px: number, height_px: number, density: number): void;
  draw(scene: Scene, camera: Camera): void;
}

/** Below this radius, device pixels, the body under a light cannot be seen. */
const BODY_MIN_PX = 2.2;

export function createCanvas2d(element: HTMLCanvasElement): StageRenderer {
  const context = element.getContext('2d', { alpha: false });
  if (!context) throw new Error('This browser cannot draw: it gives no 2D canvas.');
  const sprites = createSprites();
  const floor = createFloorLayer(sprites);
  let density = 1;

  const drawFilled = (dots: readonly Dot[], scene: Scene, camera: Camera) => {
    const radius_px = Math.max(1.2, scene.radius_m * camera.scale) * density;
    const body = sprites.body(radius_px);
    const bodyHalf = body.width / 2;
    for (const dot of dots) {
      if (radius_px < BODY_MIN_PX && sprites.glow(dot.color, radius_px)) continue;
      context.globalAlpha = 0.35 + 0.65 * dot.alpha;
      context.drawImage(
        body,
        (camera.originX_px + dot.x * camera.scale) * density - bodyHalf,
        (camera.originY_px - dot.y * camera.scale) * density - bodyHalf,
      );
    }
    context.globalCompositeOperation = 'lighter';
    for (const dot of dots) {
      const glow = sprites.glow(dot.color, radius_px);
      if (!glow) continue;
      context.globalAlpha = dot.alpha;
      context.drawImage(
        glow,
        (camera.originX_px + dot.x * camera.scale) * density - glow.width / 2,
        (camera.originY_px - dot.y * camera.scale) * density - glow.height / 2,
      );
    }
    context.globalCompositeOperation = 'source-over';
    context.globalAlpha = 1;
  };

  return {
    resize(width_px, height_px, nextDensity) {
      density = nextDensity;
      element.width = Math.max(1, Math.round(width_px * density));
      element.height = Math.max(1, Math.round(height_px * density));
    },
    draw(scene, camera) {
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.drawImage(floor.of(scene, camera, element, density), 0, 0);
      drawFilled(scene.filled, scene, camera);
      context.setTransform(density, 0, 0, density, 0, 0);
      drawErrors(context, scene, camera);
      scene.overlay?.(context, camera);
    },
  };
}

function drawErrors(context: CanvasRenderingContext2D, scene: Scene, camera: Camera) {
  if (scene.errors.length === 0) return;
  context.strokeStyle = 'rgba(255,255,255,0.5)';
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
