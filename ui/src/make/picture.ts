import { type Box, type Point, boxOf, rotate } from '../base/geometry';
import type { MakeAnswer } from '../api/types.gen';
import type { Draft } from './draft';
import { sizeOf, type Pictures } from './pictures';

/** The box around a made picture, along the picture's own axes, which are turned with it. */
export interface Picture {
  /** Middle of the picture, stage metres. */
  center: Point;
  /** Radians counter-clockwise. */
  turn: number;
  /** Longer side of the picture, metres. */
  size_m: number;
  /** The box around the picture's lights, counted from `center` along its axes, in shares of `size_m`. */
  box: Box;
}

/** Smallest picture that is made by dragging, metres. */
export const SIZE_MIN_M = 0.1;

/** The middle of the floor: the `center` of a draft that has none. */
const MIDDLE: Point = { x: 0, y: 0 };

/**
 * The box around the lights of the answers to `draft`, as `Picture.box`; null: there are no lights. `moved`: ids of
 * pixels that were moved by hand and are left out.
 */
export function lightsBox(
  answers: readonly MakeAnswer[],
  draft: Draft,
  moved: readonly number[],
): Box | null {
  const center = draft.center ?? MIDDLE;
  const kept = new Set(moved);
  const places = answers
    .filter(({ size_m }) => size_m > 0)
    .flatMap(({ pixels, size_m }) =>
      pixels
        .filter((p) => p.part !== null && !kept.has(p.id))
        .map(({ place: [x, y] }) => {
          const p = rotate({ x, y }, center, -draft.turn);
          return { x: (p.x - center.x) / size_m, y: (p.y - center.y) / size_m };
        }),
    );
  return places.length === 0 ? null : boxOf(places);
}

/** The picture of the present draft, with the box of the newest answer; null: no answer with lights yet. */
export function pictureOf(
  draft: Draft,
  made: { shown: Pictures | null; box: Box | null },
): Picture | null {
  const size_m = draft.size_m ?? sizeOf(made.shown) ?? 0;
  if (made.box === null || size_m <= 0) return null;
  return { center: draft.center ?? MIDDLE, turn: draft.turn, size_m, box: made.box };
}

/** The place on the stage of a place given along the picture's axes, metres from the picture's middle. */
export const stageFromPicture = ({ center, turn }: Picture, at: Point): Point =>
  rotate({ x: center.x + at.x, y: center.y + at.y }, center, turn);

/** The place along the picture's axes, metres from the picture's middle, of a place on the stage. */
export function pictureFromStage({ center, turn }: Picture, at: Point): Point {
  const p = rotate(at, center, -turn);
  return { x: p.x - center.x, y: p.y - center.y };
}

/** A corner of a picture: for each of the picture's axes, at which end of it. */
export interface Corner {
  sx: -1 | 1;
  sy: -1 | 1;
}

export const CORNERS: readonly Corner[] = [
  { sx: -1, sy: 1 },
  { sx: 1, sy: 1 },
  { sx: 1, sy: -1 },
  { sx: -1, sy: -1 },
];

/** A corner of the box around the lights, along the picture's axes, metres from the picture's middle. */
export const cornerAt = ({ box, size_m }: Picture, { sx, sy }: Corner): Point => ({
  x: (sx > 0 ? box.maxX : box.minX) * size_m,
  y: (sy > 0 ? box.maxY : box.minY) * size_m,
});

/** The new middle of a picture that is moved by `by`, stage metres; limited by `onFloor`. */
export function movedBy(picture: Picture, by: Point, floor: Floor): Pick<Draft, 'center'> {
  const { center } = picture;
  return { center: onFloor({ x: center.x + by.x, y: center.y + by.y }, floor) };
}

export interface Floor {
  width_m: number;
  depth_m: number;
}

/** Least distance of a picture's middle from the edge of the floor, metres. */
const EDGE_M = 0.1;

/** The place nearest to `p` that is on the floor and `EDGE_M` from its edges, stage metres. */
export function onFloor(p: Point, { width_m, depth_m }: Floor): Point {
  const within = (value: number, side: number) => {
    const most = Math.max(0, side / 2 - EDGE_M);
    return Math.max(-most, Math.min(most, value));
  };
  return { x: within(p.x, width_m), y: within(p.y, depth_m) };
}

/**
 * Size and middle of a picture after its corner was dragged from one place to another, stage metres. The opposite
 * corner stays, or with `about` the middle. The size stays between `SIZE_MIN_M` and the floor's longer side.
 */
export function scaledBy(
  picture: Picture,
  corner: Corner,
  [from, to]: readonly [Point, Point],
  about: boolean,
  floor: Floor,
): Pick<Draft, 'size_m' | 'center'> {
  const { sx, sy } = corner;
  const still = about
    ? { x: 0, y: 0 }
    : cornerAt(picture, { sx: -sx as -1 | 1, sy: -sy as -1 | 1 });
  const [a, b] = [pictureFromStage(picture, from), pictureFromStage(picture, to)];
  const [ax, ay] = [a.x - still.x, a.y - still.y];
  const length = ax * ax + ay * ay;
  const wanted = length > 0 ? ((b.x - still.x) * ax + (b.y - still.y) * ay) / length : 1;
  const most_m = Math.max(floor.width_m, floor.depth_m);
  const size_m = Math.max(SIZE_MIN_M, Math.min(most_m, picture.size_m * wanted));
  const k = size_m / picture.size_m;
  const center = stageFromPicture(picture, { x: still.x * (1 - k), y: still.y * (1 - k) });
  return { size_m: rounded(size_m, 1e4), center: onFloor(center, floor) };
}

/** Step of turning with Shift, radians: 15°. */
const STEP = Math.PI / 12;

/** The turn of a picture after its knob was dragged from one place to another, stage metres; from -π to π. */
export function turnedBy(
  { center, turn }: Picture,
  [from, to]: readonly [Point, Point],
  inSteps: boolean,
): Pick<Draft, 'turn'> {
  const angle = (p: Point) => Math.atan2(p.y - center.y, p.x - center.x);
  const next = turn + angle(to) - angle(from);
  const stepped = inSteps ? Math.round(next / STEP) * STEP : next;
  return { turn: rounded(Math.atan2(Math.sin(stepped), Math.cos(stepped)), 1e4) };
}

const rounded = (value: number, parts: number) => Math.round(value * parts) / parts;
