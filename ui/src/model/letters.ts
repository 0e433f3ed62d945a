import { type Point, along } from '../base/geometry';

/** Strokes of each letter on a grid 2 wide and 4 high: points as pairs of digits x y, strokes separated by spaces. */
const STROKES: Record<string, string> = {
  A: '0003142320 0222',
  B: '000414231202 12211000',
  C: '231403011021',
  D: '00041423211000',
  E: '24040020 0212',
  F: '240400 0212',
  G: '2314030110212212',
  H: '0004 2024 0222',
  I: '1014',
  J: '24211001',
  K: '0004 240220',
  L: '040020',
  M: '0004122420',
  N: '00042024',
  O: '10010314232110',
  P: '000414231202',
  Q: '10010314232110 1120',
  R: '000414231202 1220',
  S: '23140312211001',
  T: '0424 1410',
  U: '0401102124',
  V: '041024',
  W: '0400122024',
  X: '0024 0420',
  Y: '041224 1210',
  Z: '04240020',
  '0': '10010314232110',
  '1': '031410',
  '2': '0314230020',
  '3': '03142312 12211001',
  '4': '10140121',
  '5': '24040212211000',
  '6': '2314030110211201',
  '7': '042410',
  '8': '120314231221100112',
  '9': '0110212314031223',
  '!': '1412 10',
  '?': '0314231211 10',
  '+': '1311 0222',
  '-': '0222',
  '.': '10',
};

/** From one letter to the next, grid units. */
const ADVANCE = 3.2;

/** The strokes of a word; a character without strokes is a gap. */
export function strokesOf(word: string): Point[][] {
  return [...word.toUpperCase()].flatMap((letter, index) =>
    (STROKES[letter] ?? '')
      .split(' ')
      .filter(Boolean)
      .map((stroke) =>
        Array.from({ length: stroke.length / 2 }, (_, i) => ({
          x: Number(stroke[2 * i]) + index * ADVANCE,
          y: Number(stroke[2 * i + 1]),
        })),
      ),
  );
}

const distance = (a: Point, b: Point) => Math.hypot(a.x - b.x, a.y - b.y);

const lengthOf = (line: readonly Point[]) =>
  line.slice(1).reduce((sum, p, i) => sum + distance(p, line[i] as Point), 0);

/** Points along all strokes about `gap` apart; one point where strokes meet. */
function sample(strokes: readonly Point[][], gap: number): Point[] {
  const points: Point[] = [];
  for (const stroke of strokes) {
    const count = Math.max(1, Math.round(lengthOf(stroke) / gap) + 1);
    for (const p of along(stroke, count, false))
      if (points.every((q) => distance(p, q) > gap * 0.7)) points.push(p);
  }
  return points;
}

/** Exactly `count` points that write a word, grid units; fewer than the word needs still sketch it. */
export function letterPoints(word: string, count: number): Point[] {
  const strokes = strokesOf(word);
  if (strokes.length === 0 || count <= 0) return [];
  let [low, high] = [0.01, 40];
  for (let i = 0; i < 30; i++) {
    const gap = (low + high) / 2;
    if (sample(strokes, gap).length > count) low = gap;
    else high = gap;
  }
  const points = sample(strokes, high).slice(0, count);
  const fine = sample(strokes, high / 8);
  while (points.length < count) points.push(farthest(fine, points));
  return points;
}

/** The candidate that is farthest from all points. */
function farthest(candidates: readonly Point[], points: readonly Point[]): Point {
  let [best, reach] = [candidates[0] ?? { x: 0, y: 0 }, -1];
  for (const c of candidates) {
    const nearest = Math.min(...points.map((p) => distance(c, p)));
    if (nearest > reach) [best, reach] = [c, nearest];
  }
  return { ...best };
}
