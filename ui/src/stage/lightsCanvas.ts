import type { Dot } from '../base/geometry';
import { brightnessOf, createLightSprites, LIGHT_RADII } from './lightSprites';
import { newSeen, type Projection } from './projection';

/** Draws nothing but lights on black, as an audience in a dark hall sees them. */
export interface LightsCanvas {
  resize(width_px: number, height_px: number, density: number): void;
  draw(lights: readonly Dot[], radius_m: number, projection: Projection): void;
}

/** Lights that are darker are not seen. */
const SEEN_MIN = 0.01;
/** Least radius of a light, CSS pixels. */
const RADIUS_MIN_PX = 1.2;
/** How flat a light is in perspective: 0 for a ball, 1 for a disc on the floor. It is a dome that lights what is around. */
const LIGHT_FLAT = 0.5;
/** The light that the floor gives back: its radius in radii of the robot, and its strength. */
const FLOOR_RADII = 7;
const FLOOR_STRENGTH = 0.1;
/** The floor's light is soft, so a picture of a quarter of the width is enough for it. */
const FLOOR_SHRUNK = 4;

export function createLightsCanvas(element: HTMLCanvasElement): LightsCanvas {
  const context = element.getContext('2d', { alpha: false });
  const floor = new OffscreenCanvas(1, 1);
  const floorContext = floor.getContext('2d', { alpha: false });
  if (!context || !floorContext)
    throw new Error('This browser cannot draw: it gives no 2D canvas.');
  const sprites = createLightSprites();
  const seen = newSeen();
  let density = 1;

  /** Adds each light with a reach of `radii` robots to a picture that has `density` pixels a CSS pixel. */
  const add = (
    into: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D,
    lights: readonly Dot[],
    radius_m: number,
    projection: Projection,
    look: { radii: number; strength: number; density: number; flat: number },
  ) => {
    for (const light of lights) {
      const brightness = brightnessOf(light.color) * light.alpha;
      if (brightness < SEEN_MIN) continue;
      projection(light, seen);
      if (seen.scale === 0) continue;
      const reach = Math.max(RADIUS_MIN_PX, radius_m * seen.scale) * look.radii;
      const rise = reach * seen.flatness ** look.flat;
      into.globalAlpha = brightness * look.strength;
      into.drawImage(
        sprites.of(light.color, 2 * reach * look.density),
        seen.x_px - reach,
        seen.y_px - rise,
        2 * reach,
        2 * rise,
      );
    }
  };

  return {
    resize(width_px, height_px, nextDensity) {
      density = nextDensity;
      element.width = Math.max(1, Math.round(width_px * density));
      element.height = Math.max(1, Math.round(height_px * density));
      floor.width = Math.max(1, Math.ceil(element.width / FLOOR_SHRUNK));
      floor.height = Math.max(1, Math.ceil(element.height / FLOOR_SHRUNK));
    },
    draw(lights, radius_m, projection) {
      const [width_px, height_px] = [floor.width, floor.height].map(
        (pixels) => (pixels * FLOOR_SHRUNK) / density,
      ) as [number, number];
      const floorDensity = density / FLOOR_SHRUNK;
      floorContext.setTransform(floorDensity, 0, 0, floorDensity, 0, 0);
      floorContext.clearRect(0, 0, width_px, height_px);
      floorContext.globalCompositeOperation = 'lighter';
      add(floorContext, lights, radius_m, projection, {
        radii: FLOOR_RADII,
        strength: FLOOR_STRENGTH,
        density: floorDensity,
        flat: 1,
      });
      context.setTransform(density, 0, 0, density, 0, 0);
      context.globalAlpha = 1;
      context.globalCompositeOperation = 'copy';
      context.drawImage(floor, 0, 0, width_px, height_px);
      context.globalCompositeOperation = 'lighter';
      add(context, lights, radius_m, projection, {
        radii: LIGHT_RADII,
        strength: 1,
        density,
        flat: LIGHT_FLAT,
      });
    },
  };
}
