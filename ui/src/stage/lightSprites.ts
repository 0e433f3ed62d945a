import { blue, green, red, type Rgb } from '../base/colour';

/** Radius of a light with its glow, in radii of the robot. */
export const LIGHT_RADII = 3.6;

/** Sides of the sprites, pixels; a light is drawn from the next larger one, or from the largest. */
const SIDES_PX = [16, 32, 64, 128] as const;

/** Steps of each component, relative to the brightest one, so that fades do not fill the cache. */
const TINTS = 32;
/** Most sprites in the cache: at most 100 MB of the largest. Above that all are dropped and drawn again. */
const KEPT_MAX = 1500;

/**
 * How brightly a light shines at a distance from its middle in radii of the robot: `glow` in its colour, `core` in white,
 * both 0 to 1.
 */
export function shineAt(radii: number): { glow: number; core: number } {
  if (radii >= LIGHT_RADII) return { glow: 0, core: 0 };
  const bell = (width: number) => Math.exp(-((radii / width) ** 2));
  // Down to nothing at the rim of the sprite, so that no edge is seen.
  const rim = 1 - radii / LIGHT_RADII;
  return {
    glow: (0.8 * bell(0.8) + 0.16 * bell(1.7)) * Math.min(1, 2 * rim),
    core: 0.4 * bell(0.45),
  };
}

/** Lights drawn once for each tint, at full brightness, to be added with the brightness as opacity. */
export interface LightSprites {
  /** The light of a colour that is not black, at least `side_px` wide if such a sprite exists. */
  of(color: Rgb, side_px: number): OffscreenCanvas;
}

/** The brightness of a colour, 0 to 1: that of its brightest component. */
export const brightnessOf = (color: Rgb) => Math.max(red(color), green(color), blue(color)) / 255;

/** The components of a colour at full brightness, in steps, packed into one number. */
export function tintOf(color: Rgb): number {
  const most = Math.max(1, red(color), green(color), blue(color));
  const step = (component: number) => Math.round((component / most) * TINTS);
  return (step(red(color)) * 64 + step(green(color))) * 64 + step(blue(color));
}

export function createLightSprites(): LightSprites {
  const kept = new Map<number, OffscreenCanvas>();
  return {
    of(color, side_px) {
      const found = SIDES_PX.findIndex((side) => side >= side_px);
      const level = found < 0 ? SIDES_PX.length - 1 : found;
      const tint = tintOf(color);
      const key = tint * SIDES_PX.length + level;
      let sprite = kept.get(key);
      if (!sprite) {
        if (kept.size >= KEPT_MAX) kept.clear();
        sprite = paint(tint, SIDES_PX[level] as number);
        kept.set(key, sprite);
      }
      return sprite;
    },
  };
}

function paint(tint: number, side_px: number): OffscreenCanvas {
  const sprite = new OffscreenCanvas(side_px, side_px);
  const context = sprite.getContext('2d');
  if (!context) throw new Error('This browser cannot draw: it gives no 2D canvas.');
  const picture = context.createImageData(side_px, side_px);
  const parts = [tint >> 12, (tint >> 6) & 63, tint & 63].map((step) => step / TINTS);
  const half = side_px / 2;
  for (let row = 0; row < side_px; row++)
    for (let column = 0; column < side_px; column++) {
      const away_px = Math.hypot(column + 0.5 - half, row + 0.5 - half);
      const { glow, core } = shineAt((away_px / half) * LIGHT_RADII);
      const added = parts.map((part) => Math.min(1, glow * part + core));
      // Opacity is the brightest component, so that the sum of colour and opacity loses no steps.
      const most = Math.max(...added);
      const at = (row * side_px + column) * 4;
      added.forEach((part, i) => (picture.data[at + i] = most > 0 ? (part / most) * 255 : 0));
      picture.data[at + 3] = most * 255;
    }
  context.putImageData(picture, 0, 0);
  return sprite;
}
