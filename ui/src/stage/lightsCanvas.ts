import { blue, green, red } from '../base/colour';
import type { Dot } from '../base/geometry';
import { newSeen, type Projection } from './projection';
import { LIGHT_RADII, shineAt } from './shine';
import { createStamps, type Ink, type Stamps } from './stamps';

/** Draws nothing but lights on black, as an audience in a dark hall sees them. */
export interface LightsCanvas {
  resize(width_px: number, height_px: number, density: number): void;
  draw(lights: readonly Dot[], radius_m: number, projection: Projection): void;
}

/** Lights darker than this share of full brightness are not drawn. */
const SEEN_MIN = 0.01;
/** Least radius of a robot, CSS pixels. */
const RADIUS_MIN_PX = 1.2;
/** Most pixels of the picture: those of a 1920 × 1080 projector. Lights are soft: more pixels would look the same. */
const PIXELS_MAX = 1920 * 1080;
/** How flat a light looks in perspective: 0 as a ball, 1 as a disc on the floor. Lights are domes, between the two. */
const FLATTENING = 0.5;
/** Factor between two sizes of stamps: too small to be seen. */
const SIZE_STEP = 1.06;
/** Step between the heights of stamps, as a share of the width: too small to be seen. */
const FLAT_STEP = 1 / 16;
/** Most stamps that are kept, one per size and height; above that all are dropped. A perspective needs about thirty. */
const SIZES_MAX = 120;
/** An opaque black pixel as one number of a little-endian machine: alpha, blue, green, red. */
const BLACK = 0xff000000;

/** A rectangle of the picture, pixels; empty if `left` is not less than `right`. */
interface Area {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

const NO_AREA: Readonly<Area> = { left: Infinity, top: Infinity, right: 0, bottom: 0 };

export function createLightsCanvas(element: HTMLCanvasElement): LightsCanvas {
  const context = element.getContext('2d', { alpha: false, willReadFrequently: true });
  if (!context) throw new Error('This browser cannot draw: it gives no 2D canvas.');
  const stampsOf = rememberStamps();
  const seen = newSeen();
  let density = 1;
  let frame = new ImageData(1, 1);
  let lit: Area = { ...NO_AREA };

  /** Adds a light to the picture, and the pixels around it to `area`. */
  const add = (light: Dot, radius_m: number, projection: Projection, area: Area) => {
    const brightness = brightnessOf(light);
    if (brightness < SEEN_MIN) return;
    projection(light, seen);
    if (seen.scale === 0) return;
    const radius_px = Math.max(RADIUS_MIN_PX, radius_m * seen.scale) * density;
    const [x, y] = [seen.x_px * density, seen.y_px * density];
    stampsOf(radius_px, seen.flatness ** FLATTENING).pressAt(frame, light, x, y);
    const reach = radius_px * LIGHT_RADII * SIZE_STEP + 2;
    area.left = Math.min(area.left, x - reach);
    area.top = Math.min(area.top, y - reach);
    area.right = Math.max(area.right, x + reach);
    area.bottom = Math.max(area.bottom, y + reach);
  };

  return {
    resize(width_px, height_px, wanted) {
      density = Math.min(wanted, Math.sqrt(PIXELS_MAX / Math.max(1, width_px * height_px)));
      element.width = Math.max(1, Math.round(width_px * density));
      element.height = Math.max(1, Math.round(height_px * density));
      frame = new ImageData(element.width, element.height);
      new Uint32Array(frame.data.buffer).fill(BLACK);
      lit = { ...NO_AREA };
    },
    draw(lights, radius_m, projection) {
      blacken(frame, lit);
      const now = { ...NO_AREA };
      for (const light of lights) add(light, radius_m, projection, now);
      // Only what was lit or is lit changes.
      const changed = within(frame, around(lit, now));
      lit = now;
      const { left, top, right, bottom } = changed;
      if (left < right) context.putImageData(frame, 0, 0, left, top, right - left, bottom - top);
    },
  };
}

/** The brightness of a light, 0 to 1: that of its brightest component. */
const brightnessOf = ({ color, alpha }: Dot) =>
  (Math.max(red(color), green(color), blue(color)) / 255) * alpha;

function lightInk(light: Dot, ink: Ink) {
  const { color, alpha } = light;
  ink.r = red(color) * alpha;
  ink.g = green(color) * alpha;
  ink.b = blue(color) * alpha;
  ink.white = 255 * brightnessOf(light);
}

/** Stamps for a robot's radius in pixels and a height as a share of the width, both rounded to steps. */
function rememberStamps(): (radius_px: number, flatness: number) => Stamps {
  const kept = new Map<number, Stamps>();
  return (radius_px, flatness) => {
    const size = Math.round(Math.log(radius_px) / Math.log(SIZE_STEP));
    const flat = Math.round(flatness / FLAT_STEP);
    const key = size * 64 + flat;
    let stamps = kept.get(key);
    if (!stamps) {
      if (kept.size >= SIZES_MAX) kept.clear();
      const stepped_px = SIZE_STEP ** size;
      stamps = createStamps(
        {
          reach_px: stepped_px * LIGHT_RADII,
          flatness: Math.max(FLAT_STEP, flat * FLAT_STEP),
          bodyAt: (away_px) => shineAt(away_px / stepped_px).glow,
          shineAt: (away_px) => shineAt(away_px / stepped_px).core,
        },
        lightInk,
      );
      kept.set(key, stamps);
    }
    return stamps;
  };
}

const around = (a: Area, b: Area): Area => ({
  left: Math.min(a.left, b.left),
  top: Math.min(a.top, b.top),
  right: Math.max(a.right, b.right),
  bottom: Math.max(a.bottom, b.bottom),
});

/** The whole pixels of a picture that an area touches. */
const within = ({ width, height }: ImageData, area: Area): Area => ({
  left: Math.max(0, Math.floor(area.left)),
  top: Math.max(0, Math.floor(area.top)),
  right: Math.min(width, Math.ceil(area.right)),
  bottom: Math.min(height, Math.ceil(area.bottom)),
});

function blacken(frame: ImageData, area: Area) {
  const { left, top, right, bottom } = within(frame, area);
  const pixels = new Uint32Array(frame.data.buffer);
  for (let row = top; row < bottom && left < right; row++)
    pixels.fill(BLACK, row * frame.width + left, row * frame.width + right);
}
