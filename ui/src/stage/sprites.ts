import { blue, green, luma, red, type Rgb } from '../base/colour';
import { CORE_ALPHA, CORE_RADII, GLOW_RADII, GLOW_STOPS } from './glow';
import { FLOOR } from './palette';

/** Each component of a colour, 0 to 255, is rounded to a multiple of this, so that fades do not fill the cache. */
const STEP = 8;
/** Most glows, and most rings, in their caches; above that the cache is emptied. */
const KEPT_MAX = 1500;

/** Lights drawn once for each colour and size, then copied. */
export interface Sprites {
  /** The glow of a light of a robot's radius in device pixels, to be drawn with `lighter`; null: the light is off. */
  glow(color: Rgb, radius_px: number): ImageBitmap | null;
  /** The body of a robot under its light. */
  body(radius_px: number): ImageBitmap;
  /** A circle in a CSS colour, `line_px` thick, dashed or not. */
  ring(color: string, radius_px: number, line_px: number, dashed?: boolean): ImageBitmap;
}

/** Whether a light is too dark to be seen. */
export const isOff = (color: Rgb) => luma(color) < 0.004;

export function createSprites(): Sprites {
  const glows = new Map<number, ImageBitmap | null>();
  const bodies = new Map<number, ImageBitmap>();
  const rings = new Map<string, ImageBitmap>();
  return {
    glow(color, radius_px) {
      const size = Math.round(radius_px * 2);
      const rounded = roundColour(color);
      const key = rounded * 4096 + size;
      let sprite = glows.get(key);
      if (sprite === undefined) {
        if (glows.size >= KEPT_MAX) glows.clear();
        sprite = isOff(rounded) ? null : paintGlow(rounded, radius_px);
        glows.set(key, sprite);
      }
      return sprite;
    },
    body(radius_px) {
      const key = Math.round(radius_px * 8);
      let sprite = bodies.get(key);
      if (!sprite) {
        if (bodies.size > 32) bodies.clear();
        sprite = paintBody(radius_px);
        bodies.set(key, sprite);
      }
      return sprite;
    },
    ring(color, radius_px, line_px, dashed = false) {
      const key = `${color} ${Math.round(radius_px * 8)} ${Math.round(line_px * 8)} ${dashed}`;
      let sprite = rings.get(key);
      if (!sprite) {
        if (rings.size >= KEPT_MAX) rings.clear();
        sprite = paintRing(color, radius_px, line_px, dashed);
        rings.set(key, sprite);
      }
      return sprite;
    },
  };
}

function roundColour(c: Rgb): Rgb {
  const round = (n: number) => Math.min(255, Math.round(n / STEP) * STEP);
  return (round(red(c)) << 16) | (round(green(c)) << 8) | round(blue(c));
}

function canvas(size: number): [OffscreenCanvas, OffscreenCanvasRenderingContext2D] {
  const element = new OffscreenCanvas(size, size);
  const context = element.getContext('2d');
  if (!context) throw new Error('This browser cannot draw: it gives no 2D canvas.');
  return [element, context];
}

function paintGlow(color: Rgb, radius_px: number): ImageBitmap {
  const reach = radius_px * GLOW_RADII;
  const [element, context] = canvas(Math.max(4, Math.ceil(reach * 2)));
  const half = element.width / 2;
  const [r, g, b] = [red(color), green(color), blue(color)];
  const tint = (alpha: number) => `rgba(${r},${g},${b},${alpha})`;
  const glow = context.createRadialGradient(half, half, 0, half, half, reach);
  for (const [radii, alpha] of GLOW_STOPS) glow.addColorStop(radii / GLOW_RADII, tint(alpha));
  context.fillStyle = glow;
  context.fillRect(0, 0, element.width, element.height);
  const core = context.createRadialGradient(half, half, 0, half, half, radius_px * CORE_RADII);
  core.addColorStop(0, `rgba(255,255,255,${CORE_ALPHA})`);
  core.addColorStop(1, 'rgba(255,255,255,0)');
  context.globalCompositeOperation = 'lighter';
  context.globalAlpha = Math.min(1, 0.25 + luma(color));
  context.fillStyle = core;
  context.fillRect(0, 0, element.width, element.height);
  return element.transferToImageBitmap();
}

function paintBody(radius_px: number): ImageBitmap {
  const [element, context] = canvas(Math.max(4, Math.ceil(radius_px * 2 + 4)));
  const half = element.width / 2;
  context.beginPath();
  context.arc(half, half, Math.max(1, radius_px - 0.5), 0, 2 * Math.PI);
  context.fillStyle = FLOOR.body;
  context.fill();
  context.lineWidth = Math.max(1, radius_px * 0.12);
  context.strokeStyle = FLOOR.rim;
  context.stroke();
  return element.transferToImageBitmap();
}

function paintRing(color: string, radius_px: number, line_px: number, dashed: boolean) {
  const [element, context] = canvas(Math.ceil(radius_px * 2 + line_px + 3));
  const half = element.width / 2;
  if (dashed) context.setLineDash([line_px * 1.7, line_px * 1.4]);
  context.lineWidth = line_px;
  context.strokeStyle = color;
  context.beginPath();
  context.arc(half, half, radius_px, 0, 2 * Math.PI);
  context.stroke();
  return element.transferToImageBitmap();
}
