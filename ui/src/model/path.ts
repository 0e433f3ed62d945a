import type { Point } from '../base/geometry';
import type { Path } from '../api/types.gen';

/** Position on a path `t` seconds after its start; before it the start, after it the end. */
export function pathAt(path: Path, t: number): Point {
  let [x, y] = path.start;
  let left = Math.max(0, t);
  for (const [duration, c1x, c1y, c2x, c2y, endX, endY] of path.pieces) {
    if (left < duration) {
      const u = left / duration;
      return {
        x: cubic(x, c1x, c2x, endX, u),
        y: cubic(y, c1y, c2y, endY, u),
      };
    }
    left -= duration;
    [x, y] = [endX, endY];
  }
  return { x, y };
}

function cubic(a: number, b: number, c: number, d: number, u: number): number {
  const w = 1 - u;
  return a * w * w * w + 3 * b * w * w * u + 3 * c * w * u * u + d * u * u * u;
}

/** Points along a path for drawing: a straight piece adds its end only, a curved one ten points. */
export function polyline(path: Path): Point[] {
  let [x, y] = path.start;
  const points: Point[] = [{ x, y }];
  for (const [, c1x, c1y, c2x, c2y, endX, endY] of path.pieces) {
    const steps = isStraight(x, y, c1x, c1y, c2x, c2y, endX, endY) ? 1 : 10;
    for (let k = 1; k <= steps; k++) {
      const u = k / steps;
      points.push({ x: cubic(x, c1x, c2x, endX, u), y: cubic(y, c1y, c2y, endY, u) });
    }
    [x, y] = [endX, endY];
  }
  return points;
}

function isStraight(x: number, y: number, ...rest: number[]): boolean {
  const [ax, ay, bx, by, ex, ey] = rest as [number, number, number, number, number, number];
  const length = Math.hypot(ex - x, ey - y);
  const off = (px: number, py: number) => Math.abs((px - x) * (ey - y) - (py - y) * (ex - x));
  return off(ax, ay) <= 1e-4 * length + 1e-12 && off(bx, by) <= 1e-4 * length + 1e-12;
}
