import { expect, test } from 'vitest';
import type { MakeAnswer } from '../api/types.gen';
import { newDraft, sourcesOf } from './draft';
import {
  cornerAt,
  lightsBox,
  movedBy,
  pictureFromStage,
  pictureOf,
  scaledBy,
  stageFromPicture,
  turnedBy,
  type Picture,
} from './picture';

const floor = { width_m: 4, depth_m: 3 };
const TURN = Math.PI / 6;

/** A picture of 1 m by 0.5 m about (0.5, 0.25), turned by 30°. */
const picture: Picture = {
  center: { x: 0.5, y: 0.25 },
  turn: TURN,
  size_m: 1,
  box: { minX: -0.5, maxX: 0.5, minY: -0.25, maxY: 0.25 },
};

function answer(places: [number, number][], size_m: number): MakeAnswer {
  const pixels = places.map((place, id) => ({
    ...{ id, place, color: '#ffffff', robot: null, part: '' },
  }));
  const none = { closest_m: null, readability: null, enough: null, notes: [], error: null };
  return { pixels, size_m, ...none };
}

test('the box around the lights is found along the axes of the turned picture', () => {
  const corners = [
    [-0.5, -0.25],
    [0.5, 0.25],
    [0, 0],
  ] as const;
  const places = corners.map(([x, y]): [number, number] => {
    const p = stageFromPicture(picture, { x, y });
    return [p.x, p.y];
  });
  const draft = { ...newDraft('shape'), center: picture.center, turn: TURN };
  const [source] = sourcesOf(draft);
  if (!source) throw new Error('no source');
  const made = answer([...places, [1.9, 1.4]], 1);
  const shown = {
    pictures: [{ source, name: null, airTime_s: null, answer: made }],
    ...{ slowdown: 1, notes: [], error: null },
  };
  const box = lightsBox([made], draft, [3]);
  for (const side of ['minX', 'maxX', 'minY', 'maxY'] as const)
    expect(box?.[side]).toBeCloseTo(picture.box[side], 9);
  expect(pictureOf({ ...draft, size_m: 2 }, { shown, box })?.size_m).toBe(2);
  expect(pictureOf(draft, { shown, box })?.size_m).toBe(1);
  expect(lightsBox([answer([], 1)], draft, [])).toBeNull();
});

test('a dragged corner keeps the opposite corner, or the middle, where it is', () => {
  const corner = { sx: 1, sy: 1 } as const;
  const at = stageFromPicture(picture, cornerAt(picture, corner));
  const to = stageFromPicture(picture, { x: 1, y: 0.5 });
  const grown = scaledBy(picture, corner, [at, to], false, floor);
  expect(grown.size_m).toBeCloseTo(1.5, 4);
  const after = { ...picture, ...grown, size_m: grown.size_m ?? 0, center: grown.center ?? at };
  const still = cornerAt(picture, { sx: -1, sy: -1 });
  const [a, b] = [
    stageFromPicture(picture, still),
    stageFromPicture(after, cornerAt(after, { sx: -1, sy: -1 })),
  ];
  expect(b.x).toBeCloseTo(a.x, 3);
  expect(b.y).toBeCloseTo(a.y, 3);
  const about = scaledBy(picture, corner, [at, to], true, floor);
  expect(about).toEqual({ size_m: 2, center: picture.center });
  const tiny = scaledBy(picture, corner, [at, stageFromPicture(picture, still)], false, floor);
  expect(tiny.size_m).toBe(0.1);
});

test('a picture is moved on the floor and turned, with Shift in steps', () => {
  expect(movedBy(picture, { x: 0.1, y: -0.2 }, floor).center).toEqual({
    x: expect.closeTo(0.6, 9) as number,
    y: expect.closeTo(0.05, 9) as number,
  });
  expect(movedBy(picture, { x: 9, y: -9 }, floor).center).toEqual({ x: 1.9, y: -1.4 });
  const from = { x: 1.5, y: 0.25 };
  expect(turnedBy(picture, [from, { x: 0.5, y: 1 }], false).turn).toBeCloseTo(
    TURN + Math.PI / 2,
    4,
  );
  const about40 = { x: 0.5 + Math.cos(0.7), y: 0.25 + Math.sin(0.7) };
  expect(turnedBy(picture, [from, about40], true).turn).toBeCloseTo(TURN + Math.PI / 4, 4);
  const p = { x: 0.3, y: -0.1 };
  expect(pictureFromStage(picture, stageFromPicture(picture, p)).x).toBeCloseTo(p.x, 9);
});
