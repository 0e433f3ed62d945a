import type { Dot } from '../base/geometry';
import type { Camera } from './camera';

/** Positions within a pixel with a stamp of their own, along each axis: a slow dot still moves smoothly. */
const PHASES = 4;

/** Pixels of a picture, RGBA, rows from the top. */
export interface Pixels {
  data: Uint8ClampedArray;
  width: number;
  height: number;
}

/** A round shape as coverage of the pixels around its middle, 0 to 255. */
interface Stamp {
  side: number;
  /** Coverage in the ink's colour, rows from the top. */
  body: Uint8Array;
  /** Coverage in white. */
  shine: Uint8Array;
  /** First covered column of every row, and the column after its last. */
  from: Uint16Array;
  until: Uint16Array;
}

/** A round shape: coverage and brightness by the distance from its middle in pixels, 0 to 1; zero beyond `reach_px`. */
export interface Round {
  reach_px: number;
  /** Height as a share of the width, for a circle that is seen from the side; 1 by default. */
  flatness?: number;
  bodyAt(away_px: number): number;
  shineAt(away_px: number): number;
}

/** Colour of a stamp: the value added to each component at full coverage, 0 to 255. */
export interface Ink {
  r: number;
  g: number;
  b: number;
  /** Added by the shine. */
  white: number;
  /** Share of the background that the body hides: 0 adds light only, 1 replaces the background. */
  covers: number;
}

/** Paints a stamp at every dot, in the dot's ink. */
export interface Stamps {
  press(pixels: Pixels, dots: readonly Dot[], camera: Camera, density: number): void;
  /** Paints one stamp with its middle at a place of the picture, pixels. */
  pressAt(pixels: Pixels, dot: Dot, x: number, y: number): void;
}

export function createStamps(round: Round, inkOf: (dot: Dot, ink: Ink) => void): Stamps {
  const stamps: (Stamp | undefined)[] = [];
  const ink: Ink = { r: 0, g: 0, b: 0, white: 0, covers: 0 };
  const stampAt = (x: number, y: number) => {
    const phaseX = Math.floor((x - Math.floor(x)) * PHASES);
    const phaseY = Math.floor((y - Math.floor(y)) * PHASES);
    const index = phaseY * PHASES + phaseX;
    return (stamps[index] ??= makeStamp(round, (phaseX + 0.5) / PHASES, (phaseY + 0.5) / PHASES));
  };
  const pressAt: Stamps['pressAt'] = (pixels, dot, x, y) => {
    inkOf(dot, ink);
    pressOne(pixels, stampAt(x, y), Math.floor(x), Math.floor(y), ink);
  };
  return {
    press(pixels, dots, camera, density) {
      for (const dot of dots) {
        const x = (camera.originX_px + dot.x * camera.scale) * density;
        const y = (camera.originY_px - dot.y * camera.scale) * density;
        pressAt(pixels, dot, x, y);
      }
    },
    pressAt,
  };
}

function makeStamp(round: Round, offX: number, offY: number): Stamp {
  const { reach_px, flatness = 1, bodyAt, shineAt } = round;
  const reach = Math.ceil(reach_px);
  const side = 2 * reach + 1;
  const [body, shine] = [new Uint8Array(side * side), new Uint8Array(side * side)];
  const [from, until] = [new Uint16Array(side).fill(side), new Uint16Array(side)];
  for (let row = 0; row < side; row++)
    for (let column = 0; column < side; column++) {
      const away_px = Math.hypot(
        column + 0.5 - reach - offX,
        (row + 0.5 - reach - offY) / flatness,
      );
      const i = row * side + column;
      body[i] = Math.round(255 * bodyAt(away_px));
      shine[i] = Math.round(255 * shineAt(away_px));
      if (body[i] === 0 && shine[i] === 0) continue;
      from[row] = Math.min(from[row] ?? 0, column);
      until[row] = column + 1;
    }
  return { side, body, shine, from, until };
}

/** Paints one stamp: the innermost loop of the rasteriser. */
function pressOne({ data, width, height }: Pixels, stamp: Stamp, x: number, y: number, ink: Ink) {
  const { side, body, shine, from, until } = stamp;
  const reach = (side - 1) / 2;
  const [left, top] = [x - reach, y - reach];
  const [r, g, b] = [ink.r / 255, ink.g / 255, ink.b / 255];
  const [white, covers] = [ink.white / 255, ink.covers / 255];
  for (let row = Math.max(0, -top); row < side && top + row < height; row++) {
    const first = Math.max(from[row] ?? 0, -left);
    const end = Math.min(until[row] ?? 0, width - left);
    let at = ((top + row) * width + left + first) * 4;
    for (let k = row * side + first; k < row * side + end; k++, at += 4) {
      const share = body[k] as number;
      const added = (shine[k] as number) * white;
      const kept = 1 - share * covers;
      // The clamped array limits sums to 255.
      data[at] = (data[at] as number) * kept + share * r + added;
      data[at + 1] = (data[at + 1] as number) * kept + share * g + added;
      data[at + 2] = (data[at + 2] as number) * kept + share * b + added;
    }
  }
}
