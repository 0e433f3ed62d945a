import { toHex } from '../base/colour';
import type { Camera, Size } from './camera';
import { drawFloor, drawPaths } from './floor';
import type { Scene } from './scene';
import type { Sprites } from './sprites';

/** What lies still under the lights: floor, planned ways and planned places, painted once and then copied. */
export interface FloorLayer {
  /** A picture as large as `size`, device pixels; painted anew only when something on it changed. */
  of(
    scene: Scene,
    camera: Camera,
    size: { width: number; height: number },
    density: number,
  ): FloorPicture;
}

export interface FloorPicture {
  canvas: HTMLCanvasElement;
  /** Its pixels, read once for each picture. */
  pixels(): Uint8ClampedArray;
}

/** Colour of a planned place whose light is off. */
const OFF = '#7d889c';

export function createFloorLayer(sprites: Sprites): FloorLayer {
  const layer = document.createElement('canvas');
  const context = layer.getContext('2d', { alpha: false, willReadFrequently: true });
  if (!context) throw new Error('This browser cannot draw: it gives no 2D canvas.');
  let painted: unknown[] = [];
  let read: Uint8ClampedArray | null = null;
  const picture: FloorPicture = {
    canvas: layer,
    pixels: () => (read ??= context.getImageData(0, 0, layer.width, layer.height).data),
  };

  const drawHollow = (scene: Scene, camera: Camera, density: number) => {
    const radius_px = Math.max(2, scene.radius_m * camera.scale) * density;
    const line_px = Math.max(density, Math.min(2 * density, radius_px * 0.16));
    for (const dot of scene.hollow) {
      const ring = sprites.ring(dot.color === 0 ? OFF : toHex(dot.color), radius_px, line_px);
      context.globalAlpha = 0.7 * dot.alpha;
      context.drawImage(
        ring,
        (camera.originX_px + dot.x * camera.scale) * density - ring.width / 2,
        (camera.originY_px - dot.y * camera.scale) * density - ring.height / 2,
      );
    }
    context.globalAlpha = 1;
  };

  return {
    of(scene, camera, { width, height }, density) {
      const { width_m, depth_m, radius_m, grid, unit, obstacles, hollow, paths } = scene;
      const wanted = [
        ...[camera, width, height, density, width_m, depth_m, radius_m, grid, obstacles],
        ...[hollow, paths, unit],
      ];
      if (wanted.every((input, i) => input === painted[i])) return picture;
      [painted, read] = [wanted, null];
      if (layer.width !== width) layer.width = width;
      if (layer.height !== height) layer.height = height;
      const size: Size = { width_px: width / density, height_px: height / density };
      context.setTransform(density, 0, 0, density, 0, 0);
      drawFloor(context, scene, camera, size);
      drawPaths(context, scene, camera);
      context.setTransform(1, 0, 0, 1, 0, 0);
      drawHollow(scene, camera, density);
      return picture;
    },
  };
}
