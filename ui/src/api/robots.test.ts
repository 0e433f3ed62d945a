import { expect, test } from 'vitest';
import { readRobots } from './robots';

/** Two robots as `crates/api/src/robots.rs` writes them, which has a test of the same bytes. */
const TWO = [
  ...[2, 0, 0, 0],
  ...[0, 0, 0, 0x3f, 0, 0, 0xc0, 0x7f],
  ...[0, 0, 0xa0, 0xbf, 0, 0, 0xc0, 0x7f],
  ...[0, 0, 0x40, 0x3f, 0, 0, 0, 0],
  ...[0, 0, 0x80, 0x3f, 0, 0, 0, 0x40],
  ...[0, 0, 0x40, 0x40, 0, 0, 0x80, 0x40],
  ...[0, 0, 0xa0, 0x40, 0, 0, 0xc0, 0x40],
  ...[0, 0x80, 0xff, 0, 1, 0, 0, 0],
  ...[2, 6],
];
const bytes = (list: number[]) => new Uint8Array(list).buffer;

test('every list is read from its place', () => {
  const robots = readRobots(bytes(TWO));
  const lists = Object.entries(robots ?? {}).map(([name, list]) => [name, [...list]]);
  expect(Object.fromEntries(lists)).toEqual({
    x: [0.5, NaN],
    y: [-1.25, NaN],
    planned_x: [0.75, 0],
    planned_y: [1, 2],
    goal_x: [3, 4],
    goal_y: [5, 6],
    colour: [0xff8000, 1],
    status: [2, 6],
  });
});

test('what is no such message is none', () => {
  for (let length = 0; length < TWO.length; length++)
    expect(readRobots(bytes(TWO.slice(0, length)))).toBeNull();
  expect(readRobots(bytes([...TWO, 0]))).toBeNull();
  expect(readRobots(bytes([0, 0, 0, 0]))?.x).toHaveLength(0);
});
