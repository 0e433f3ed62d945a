import { blue, green, luma, red } from '../base/colour';
import type { Camera } from './camera';
import type { Dot } from './scene';
import { CORE_ALPHA, CORE_RADII, GLOW_RADII, glowAlpha } from './glow';

/** Places within a pixel that have a stamp of their own, along each axis: what moves slowly still moves smoothly. */
const PHASES = 4;

/** A light in numbers: how much of its colour and of white each pixel around it gets, 0 to 255. */
interface Stamp {
  side: number;
  glow: Uint8Array;
  core: Uint8Array;
  /** First column of every row that gets any, and the one after its last. */
  from: Uint16Array;
  until: Uint16Array;
}

/** Pixels of a picture, RGBA, rows from the top. */
export interface Pixels {
  data: Uint8ClampedArray;
  width: number;
  height: number;
}

/**
 * Adds lights to a picture one by one, in plain numbers. For crowds: no sprite for each of a thousand colours that fade,
 * and as quick without a graphics card as with one.
 */
export interface Crowd {
  add(
    pixels: Pixels,
    dots: readonly Dot[],
    radius_px: number,
    camera: Camera,
    density: number,
  ): void;
}

export function createCrowd(): Crowd {
  let stamps: (Stamp | undefined)[] = [];
  let made_px = 0;

  const stampAt = (x: number, y: number, radius_px: number): Stamp => {
    const [px, py] = [
      Math.floor((x - Math.floor(x)) * PHASES),
      Math.floor((y - Math.floor(y)) * PHASES),
    ];
    return (stamps[py * PHASES + px] ??= makeStamp(
      radius_px,
      (px + 0.5) / PHASES,
      (py + 0.5) / PHASES,
    ));
  };

  return {
    add(pixels, dots, radius_px, camera, density) {
      if (radius_px !== made_px) [stamps, made_px] = [[], radius_px];
      for (const dot of dots) {
        const x = (camera.originX_px + dot.x * camera.scale) * density;
        const y = (camera.originY_px - dot.y * camera.scale) * density;
        addLight(pixels, stampAt(x, y, radius_px), Math.floor(x), Math.floor(y), dot);
      }
    },
  };
}

function makeStamp(radius_px: number, offX: number, offY: number): Stamp {
  const reach = Math.ceil(radius_px * GLOW_RADII);
  const side = 2 * reach + 1;
  const [glow, core] = [new Uint8Array(side * side), new Uint8Array(side * side)];
  const [from, until] = [new Uint16Array(side).fill(side), new Uint16Array(side)];
  for (let row = 0; row < side; row++)
    for (let column = 0; column < side; column++) {
      const away = Math.hypot(column + 0.5 - reach - offX, row + 0.5 - reach - offY) / radius_px;
      const i = row * side + column;
      glow[i] = Math.round(255 * glowAlpha(away));
      core[i] = Math.round(255 * CORE_ALPHA * Math.max(0, 1 - away / CORE_RADII));
      if (glow[i] === 0) continue;
      from[row] = Math.min(from[row] ?? 0, column);
      until[row] = column + 1;
    }
  return { side, glow, core, from, until };
}

function addLight({ data, width, height }: Pixels, stamp: Stamp, x: number, y: number, dot: Dot) {
  const { side, glow, core, from, until } = stamp;
  const reach = (side - 1) / 2;
  const [left, top] = [x - reach, y - reach];
  const strength = dot.alpha / 255;
  const [r, g, b] = [
    red(dot.color) * strength,
    green(dot.color) * strength,
    blue(dot.color) * strength,
  ];
  const white = 255 * Math.min(1, 0.25 + luma(dot.color)) * strength;
  for (let row = Math.max(0, -top); row < side && top + row < height; row++) {
    const first = Math.max(from[row] ?? 0, -left);
    const end = Math.min(until[row] ?? 0, width - left);
    let at = ((top + row) * width + left + first) * 4;
    for (let k = row * side + first; k < row * side + end; k++, at += 4) {
      const light = glow[k] as number;
      const shine = (core[k] as number) * white;
      // The array itself keeps sums below 256.
      data[at] = (data[at] as number) + light * r + shine;
      data[at + 1] = (data[at + 1] as number) + light * g + shine;
      data[at + 2] = (data[at + 2] as number) + light * b + shine;
    }
  }
}
