/** A colour as 0xRRGGBB. */
export type Rgb = number;

export const rgb = (r: number, g: number, b: number): Rgb =>
  (clampByte(r) << 16) | (clampByte(g) << 8) | clampByte(b);

const clampByte = (n: number) => Math.max(0, Math.min(255, Math.round(n)));

export const red = (c: Rgb) => (c >> 16) & 255;
export const green = (c: Rgb) => (c >> 8) & 255;
export const blue = (c: Rgb) => c & 255;

/** The colour as `#rrggbb`. */
export const toHex = (c: Rgb) => `#${c.toString(16).padStart(6, '0')}`;

/** Reads `#rgb`, `rgb`, `#rrggbb` or `rrggbb`; `undefined` for anything else. */
export function fromHex(text: string): Rgb | undefined {
  const digits = text.trim().replace(/^#/, '');
  if (/^[0-9a-f]{3}$/i.test(digits)) return parseInt(digits.replace(/./g, '$&$&'), 16);
  return /^[0-9a-f]{6}$/i.test(digits) ? parseInt(digits, 16) : undefined;
}

/** Reads hex as `fromHex` does, or `255, 128, 0` or `rgb(255 128 0)`; undefined for all else and above 255. */
export function fromText(text: string): Rgb | undefined {
  const parts = /^(?:rgb)?\(?\s*(\d{1,3})[\s,]+(\d{1,3})[\s,]+(\d{1,3})\s*\)?$/i.exec(text.trim());
  if (!parts) return fromHex(text);
  const [r, g, b] = parts.slice(1).map(Number) as [number, number, number];
  return Math.max(r, g, b) > 255 ? undefined : rgb(r, g, b);
}

/** Linear interpolation of red, green and blue; `t` from 0 (`a`) to 1 (`b`). */
export const mix = (a: Rgb, b: Rgb, t: number): Rgb =>
  rgb(
    red(a) + (red(b) - red(a)) * t,
    green(a) + (green(b) - green(a)) * t,
    blue(a) + (blue(b) - blue(a)) * t,
  );

/** Perceived brightness, 0 to 1. */
export const luma = (c: Rgb) => (0.2126 * red(c) + 0.7152 * green(c) + 0.0722 * blue(c)) / 255;

const NAMES: [string, Rgb][] = [
  ['off', 0x000000],
  ['white', 0xffffff],
  ['grey', 0x808080],
  ['dim grey', 0x303030],
  ['brown', 0x804000],
  ['sky blue', 0x18a0ff],
  ['red', 0xff0000],
  ['orange', 0xff8c00],
  ['yellow', 0xffff00],
  ['green', 0x00c800],
  ['cyan', 0x00ffff],
  ['blue', 0x0040ff],
  ['violet', 0x8000ff],
  ['pink', 0xff40a0],
];

/** The nearest of a few colour names, because colour must not be the only sign. */
export function colourName(c: Rgb): string {
  let best = NAMES[0] as [string, Rgb];
  let bestDistance = Infinity;
  for (const entry of NAMES) {
    const [dr, dg, db] = [
      red(c) - red(entry[1]),
      green(c) - green(entry[1]),
      blue(c) - blue(entry[1]),
    ];
    const distance = dr * dr + dg * dg + db * db;
    if (distance < bestDistance) [best, bestDistance] = [entry, distance];
  }
  return best[0];
}
