import { ROBOT_COLUMNS, type Robots } from './types.gen';

/** Reads the binary message with a column of numbers per field of `Robots`, without copying; null: a wrong length. */
export function readRobots(data: ArrayBuffer): Robots | null {
  if (data.byteLength < 4) return null;
  const count = new DataView(data).getUint32(0, true);
  const size = ROBOT_COLUMNS.reduce((sum, [, Numbers]) => sum + Numbers.BYTES_PER_ELEMENT, 0);
  if (data.byteLength !== 4 + count * size) return null;
  const robots: Partial<Record<keyof Robots, ArrayLike<number>>> = {};
  let at = 4;
  for (const [name, Numbers] of ROBOT_COLUMNS) {
    robots[name] = new Numbers(data, at, count);
    at += count * Numbers.BYTES_PER_ELEMENT;
  }
  return robots as Robots;
}
