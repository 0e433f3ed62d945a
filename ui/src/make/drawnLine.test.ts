import { expect, test } from 'vitest';
import { newDraft, draftOf, sourcesOf, type Draft } from './draft';
import {
  insertPoint,
  lineThrough,
  middles,
  pointsOnStage,
  POINTS_MAX,
  removePoint,
  simplified,
  withPoint,
} from './drawnLine';

const sourceOf = (draft: Draft) => sourcesOf(draft)[0] ?? null;

const floor = { width_m: 3, depth_m: 2, radius_m: 0.027 };
const zigzag = [
  { x: -1, y: -0.5 },
  { x: 0, y: 0.5 },
  { x: 1, y: -0.5 },
];

test('a line is drawn where its points are, and stays there after it was saved', () => {
  const line = lineThrough(zigzag, floor);
  expect(line).toMatchObject({ center: { x: 0, y: 0 }, size_m: 2, turn: 0 });
  expect(pointsOnStage(line, null)).toEqual(zigzag);
  const draft = { ...newDraft('shape'), shape: 'polyline', ...line };
  const source = sourceOf(draft);
  expect(source?.settings).toMatchObject({ shape: 'polyline', size_m: 2 });
  expect(source && pointsOnStage(draftOf(source), null)).toEqual(zigzag);
});

test('the points follow a picture that is moved, scaled and turned', () => {
  const line = lineThrough(zigzag, floor);
  const moved = { ...line, center: { x: 0.2, y: 0.1 }, size_m: 1, turn: Math.PI / 2 };
  const [first, , last] = pointsOnStage(moved, null);
  expect(first?.x).toBeCloseTo(0.45, 9);
  expect(first?.y).toBeCloseTo(-0.4, 9);
  expect(last?.y).toBeCloseTo(0.6, 9);
});

test('points are kept on the floor', () => {
  const { points } = lineThrough([{ x: -9, y: 0 }, { x: 0, y: 9 }], floor); // prettier-ignore
  expect(points[0]?.x).toBeCloseTo(-1.452, 4);
  expect(points[1]?.y).toBeCloseTo(0.952, 4);
});

test('points are moved, added and removed; a closed line has a piece more', () => {
  expect(withPoint(zigzag, 1, { x: 0, y: 0 })[1]).toEqual({ x: 0, y: 0 });
  expect(middles(zigzag, false).map((m) => m.index)).toEqual([1, 2]);
  expect(middles(zigzag, true).map((m) => m.index)).toEqual([1, 2, 3]);
  const [middle] = middles(zigzag, false);
  expect(middle?.at).toEqual({ x: -0.5, y: 0 });
  expect(insertPoint(zigzag, 1, { x: -0.5, y: 0 }).map((p) => p.x)).toEqual([-1, -0.5, 0, 1]);
  expect(removePoint(zigzag, 0)).toEqual(zigzag.slice(1));
  const full = Array.from({ length: POINTS_MAX }, (_, i) => ({ x: i * 1e-3, y: 0 }));
  expect(insertPoint(full, 0, { x: 9, y: 9 })).toHaveLength(POINTS_MAX);
});

test('a stroke keeps the points that draw it again', () => {
  const line = Array.from({ length: 60 }, (_, i) => ({ x: i * 0.02, y: (i % 2) * 0.004 }));
  expect(simplified(line)).toHaveLength(2);
  const wave = Array.from({ length: 101 }, (_, i) => ({ x: i / 50, y: Math.sin(i / 8) / 2 }));
  const kept = simplified(wave);
  expect(kept.length).toBeGreaterThan(10);
  expect(kept.length).toBeLessThan(40);
  expect([kept[0], kept.at(-1)]).toEqual([wave[0], wave.at(-1)]);
  const noise = Array.from({ length: 2000 }, (_, i) => ({
    x: (i * 7919) % 13,
    y: (i * 104729) % 11,
  }));
  expect(simplified(noise).length).toBeLessThanOrEqual(POINTS_MAX);
});

test('a line without two points is not made, but a straight one needs none', () => {
  const draft = newDraft('shape');
  expect(sourceOf({ ...draft, shape: 'curve' })).toBeNull();
  expect(sourceOf({ ...draft, shape: 'curve', points: zigzag.slice(0, 1) })).toBeNull();
  expect(sourceOf({ ...draft, shape: 'line' })?.settings).toEqual({ shape: 'line' });
  expect(sourceOf({ ...draft, shape: 'heart', points: zigzag })?.settings).toEqual({
    shape: 'heart',
  });
});
