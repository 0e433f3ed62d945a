import type { Point } from '../base/geometry';
import type { Camera } from './camera';
import type { Pixels } from './stamps';

/** What a line adds to red, green and blue of a pixel, 0 to 255. */
const WHITE = 110;
/** Length of the dashes and of the gaps of a line, CSS pixels. */
const DASH_PX = 3;

/** Adds thin dashed lines, in stage metres, to pixels, because a canvas takes 0.1 s for thousands of dashes. */
export function addLines(
  pixels: Pixels,
  lines: readonly (readonly [Point, Point])[],
  camera: Camera,
  density: number,
) {
  const dash = Math.round(DASH_PX * density);
  for (const [from, to] of lines) {
    const x = (camera.originX_px + from.x * camera.scale) * density;
    const y = (camera.originY_px - from.y * camera.scale) * density;
    const dx = (to.x - from.x) * camera.scale * density;
    const dy = (from.y - to.y) * camera.scale * density;
    addLine(pixels, { x, y }, { x: dx, y: dy }, dash);
  }
}

function addLine({ data, width, height }: Pixels, from: Point, way: Point, dash: number) {
  // A longer line leaves the picture.
  const steps = Math.min(width + height, Math.ceil(Math.max(Math.abs(way.x), Math.abs(way.y))));
  const longest = Math.max(Math.abs(way.x), Math.abs(way.y), 1);
  const [stepX, stepY] = [way.x / longest, way.y / longest];
  for (let k = 0; k <= steps; k++) {
    if (Math.floor(k / dash) % 2 === 1) continue;
    const [x, y] = [Math.floor(from.x + k * stepX), Math.floor(from.y + k * stepY)];
    if (x < 0 || y < 0 || x >= width || y >= height) continue;
    const at = (y * width + x) * 4;
    for (let c = at; c < at + 3; c++) data[c] = (data[c] as number) + WHITE;
  }
}
