import { blue, green, red, rgb, type Rgb } from '../base/colour';
import type { Pixel } from './show';

/** Most colours that stand for a frame. */
const PARTS = 5;
const known = new WeakMap<readonly Pixel[], readonly Rgb[]>();

/**
 * Mean colours of up to `PARTS` parts of equal size of a frame's pixels, from left to right. Empty without pixels; the
 * same list for the same list of pixels.
 */
export function frameColours(pixels: readonly Pixel[]): readonly Rgb[] {
  let colours = known.get(pixels);
  if (!colours) {
    const sorted = [...pixels].sort((a, b) => a.x - b.x);
    const parts = Math.min(PARTS, sorted.length);
    colours = Array.from({ length: parts }, (_, part) => {
      const cut = (nth: number) => Math.round((nth * sorted.length) / parts);
      return mean(sorted.slice(cut(part), cut(part + 1)));
    });
    known.set(pixels, colours);
  }
  return colours;
}

function mean(pixels: readonly Pixel[]): Rgb {
  const of = (channel: (color: Rgb) => number) =>
    pixels.reduce((sum, pixel) => sum + channel(pixel.color), 0) / pixels.length;
  return rgb(of(red), of(green), of(blue));
}
