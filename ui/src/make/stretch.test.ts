import { expect, test } from 'vitest';
import type { MakeShape } from '../api/types.gen';
import { newDraft } from './draft';
import { cornerAt, stageFromPicture, type Picture } from './picture';
import { SIDES, stretchedBy, stretchOf, type Side } from './stretch';

const floor = { width_m: 6, depth_m: 6 };
const shapes = [
  { name: 'rectangle', aspect: 1 },
  { name: 'star', aspect: 1 },
] as MakeShape[];
const draft = { ...newDraft('shape'), shape: 'rectangle', shapeNumbers: { aspect: 2 } };

/** A picture of 1 m by 0.5 m about (0.5, 0.25), turned by 30°. */
const picture: Picture = {
  center: { x: 0.5, y: 0.25 },
  turn: Math.PI / 6,
  size_m: 1,
  box: { minX: -0.5, maxX: 0.5, minY: -0.25, maxY: 0.25 },
};
const stretched = { picture, draft, stretch: { by: 'aspect', aspect: 2 } as const };

/** The settings after the middle of a side was dragged outwards by `by_m` metres, inwards if negative. */
function drag(side: Side, by_m: number, about = false) {
  const at = { x: side.sx * 0.5, y: side.sy * 0.25 };
  const to = { x: at.x + side.sx * by_m, y: at.y + side.sy * by_m };
  const places = [stageFromPicture(picture, at), stageFromPicture(picture, to)] as const;
  return stretchedBy(stretched, side, places, about, floor);
}

test('only shapes with a width to height and lines with corners are stretched', () => {
  expect(stretchOf(draft, shapes)).toEqual({ by: 'aspect', aspect: 2 });
  expect(stretchOf({ ...draft, shapeNumbers: {} }, shapes)).toEqual({ by: 'aspect', aspect: 1 });
  expect(stretchOf({ ...draft, shape: 'star' }, shapes)).toBeNull();
  expect(stretchOf({ ...draft, shape: 'line' }, shapes)).toBeNull();
  expect(stretchOf({ ...draft, shape: 'curve' }, shapes)).toEqual({ by: 'points' });
  expect(stretchOf(newDraft('text'), shapes)).toBeNull();
});

test.each(SIDES)('dragging side %o keeps the opposite side and the other length', (side) => {
  const after = drag(side, 0.25);
  const [w, h] = side.sx === 0 ? [1, 0.75] : [1.25, 0.5];
  expect(after.size_m).toBeCloseTo(Math.max(w, h), 4);
  expect(after.shapeNumbers?.aspect).toBeCloseTo(w / h, 3);
  const size_m = after.size_m ?? 0;
  const now: Picture = {
    ...picture,
    ...{ center: after.center ?? { x: 0, y: 0 }, size_m },
    box: {
      ...{ minX: -w / 2 / size_m, maxX: w / 2 / size_m },
      ...{ minY: -h / 2 / size_m, maxY: h / 2 / size_m },
    },
  };
  const corner = { sx: side.sx === 0 ? 1 : -side.sx, sy: side.sy === 0 ? 1 : -side.sy } as {
    sx: -1 | 1;
    sy: -1 | 1;
  };
  const [a, b] = [picture, now].map((of) => stageFromPicture(of, cornerAt(of, corner)));
  expect(b?.x).toBeCloseTo(a?.x ?? NaN, 3);
  expect(b?.y).toBeCloseTo(a?.y ?? NaN, 3);
});

test('with the middle kept, a side moves twice; no side is shorter than 0.1 m, no shape flatter than 5 to 1', () => {
  expect(drag({ sx: 1, sy: 0 }, 0.25, true)).toMatchObject({
    size_m: 1.5,
    center: picture.center,
    shapeNumbers: { aspect: 3 },
  });
  expect(drag({ sx: 1, sy: 0 }, 9).shapeNumbers?.aspect).toBe(5);
  expect(drag({ sx: 0, sy: 1 }, -9).shapeNumbers?.aspect).toBe(5);
});

test('a drawn line is stretched by its points', () => {
  const points = [
    { x: 0, y: 0 },
    { x: 1, y: 0 },
    { x: 1, y: 0.5 },
  ];
  const line = { picture, draft: { ...draft, points }, stretch: { by: 'points' } as const };
  const places = [
    stageFromPicture(picture, { x: 0.5, y: 0 }),
    stageFromPicture(picture, { x: 1.5, y: 0 }),
  ] as const;
  const after = stretchedBy(line, { sx: 1, sy: 0 }, places, false, floor);
  expect(after.points).toEqual([
    { x: -0.5, y: 0 },
    { x: 1.5, y: 0 },
    { x: 1.5, y: 0.5 },
  ]);
  expect(after.size_m).toBe(2);
});
