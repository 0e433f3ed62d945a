import type { Camera, Size } from './camera';
import type { Rasteriser } from './rasteriser';
import { drawFloor, drawPaths } from './floor';
import type { Scene } from './scene';

/** The layer under the lights: floor, planned paths and targets, painted when they change and otherwise copied. */
export interface FloorLayer {
  /** A picture of `size`, device pixels; repainted only when one of its inputs changed. */
  of(
    scene: Scene,
    camera: Camera,
    size: { width: number; height: number },
    density: number,
  ): FloorPicture;
}

export interface FloorPicture {
  canvas(): HTMLCanvasElement;
  pixels: ImageData;
}

export function createFloorLayer(rasteriser: Rasteriser): FloorLayer {
  const layer = document.createElement('canvas');
  const context = layer.getContext('2d', { alpha: false, willReadFrequently: true });
  if (!context) throw new Error('This browser cannot draw: it gives no 2D canvas.');
  const isNewFloor = createChangeWatch();
  const isNewPicture = createChangeWatch();
  let bare = new ImageData(1, 1);
  let isOnCanvas = false;
  const picture: FloorPicture = {
    pixels: bare,
    canvas() {
      if (!isOnCanvas) context.putImageData(picture.pixels, 0, 0);
      isOnCanvas = true;
      return layer;
    },
  };

  /** Floor and planned paths. */
  const paintFloor = (scene: Scene, camera: Camera, size: Size, density: number) => {
    context.setTransform(density, 0, 0, density, 0, 0);
    drawFloor(context, scene, camera, size);
    drawPaths(context, scene, camera);
    bare = context.getImageData(0, 0, layer.width, layer.height);
    picture.pixels = new ImageData(layer.width, layer.height);
  };

  return {
    of(scene, camera, { width, height }, density) {
      const { width_m, depth_m, radius_m, grid, unit, obstacles, hollow, paths } = scene;
      const floor = [
        ...[camera, width, height, density, width_m, depth_m, radius_m, grid, unit],
        ...[obstacles, paths],
      ];
      if (isNewFloor(floor)) {
        if (layer.width !== width) layer.width = width;
        if (layer.height !== height) layer.height = height;
        paintFloor(
          scene,
          camera,
          { width_px: width / density, height_px: height / density },
          density,
        );
      }
      if (isNewPicture([bare, hollow, radius_m])) {
        picture.pixels.data.set(bare.data);
        const radius_px = Math.max(2, radius_m * camera.scale) * density;
        rasteriser.layRings(picture.pixels, hollow, radius_px, camera, density);
        isOnCanvas = false;
      }
      return picture;
    },
  };
}

/** A function that tells whether a list of inputs differs from the list of its last call. */
function createChangeWatch() {
  let last: readonly unknown[] = [];
  return (inputs: readonly unknown[]): boolean => {
    const isNew = inputs.length !== last.length || inputs.some((input, i) => input !== last[i]);
    last = inputs;
    return isNew;
  };
}
