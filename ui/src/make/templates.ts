import { toHex } from '../base/colour';
import type { FrameSource } from '../model/sources';
import { sourceTitle } from './draft';

/** A show to begin with: what its frames are made from, by the number of robots. */
export interface Template {
  id: string;
  title: string;
  /** Index of the frame that is shown as the template's picture. */
  face: number;
  frames(robots: number): TemplateFrame[];
}

/** A frame of a template. */
export interface TemplateFrame {
  name: string;
  airTime_s: number;
  source: FrameSource;
  /** Factor by which the picture is larger than its automatic size, as far as the floor allows; 1: as it is. */
  grown: number;
}

/** Colours of light. */
const GOLD = toHex(0xffb030);
const WHITE = toHex(0xffffff);
const RED = toHex(0xff2a2a);
const PINK = toHex(0xff2f92);
const ORANGE = toHex(0xff7a00);
const BLUE = toHex(0x18a0ff);
const TEAL = toHex(0x00e0c8);
const VIOLET = toHex(0x9a5cff);
const GREEN = toHex(0x2ee55c);

/** Colours that letters take in turn. */
const LETTERS = [GOLD, PINK, VIOLET, BLUE, TEAL, GREEN];

const source = (kind: 'text' | 'shape', settings: FrameSource['settings']): FrameSource => ({
  kind,
  asset: null,
  seed: 1,
  box: null,
  moved: [],
  series: null,
  moment_s: null,
  settings,
});

const words = (text: string, airTime_s: number, colors: readonly string[]): TemplateFrame => ({
  name: text,
  airTime_s,
  source: source('text', { text, font: 'lato', colors }),
  grown: 1,
});

const shape = (
  name: string,
  shape: string,
  airTime_s: number,
  color: string,
  settings: FrameSource['settings'] = {},
  grown = 1,
): TemplateFrame => ({
  name,
  airTime_s,
  source: source('shape', { shape, color: [color], ...settings }),
  grown,
});

/** Words of welcome, each with the number of robots from which it is used: the module says it is readable then. */
const WELCOMES: readonly [string, number][] = [
  ['WELCOME', 64],
  ['HELLO', 45],
];

/** The longest word of welcome that a number of robots can write readably; at least `HI`. */
export const welcomeFor = (robots: number) =>
  WELCOMES.find(([, needed]) => robots >= needed)?.[0] ?? 'HI';

const QUARTER = Math.PI / 2;

/** Turns of a spiral for a number of robots, 1 to 5: more robots have room for more arms. */
const turnsFor = (robots: number) => Math.max(1, Math.min(5, Math.round(Math.sqrt(robots / 12))));

/** The frames of a show of the user's words: the words first, because the editor opens on the first frame; a ring. */
export function wordShow(text: string): TemplateFrame[] {
  const own = words(text, 6, LETTERS);
  return [
    { ...own, name: sourceTitle(own.source, null) },
    shape('Ring', 'circle', 2, GOLD, { style: 'outline' }),
  ];
}

/** Ten shows to begin with. */
export const TEMPLATES: readonly Template[] = [
  {
    id: 'welcome',
    title: 'Welcome',
    face: 1,
    frames: (robots) => [
      shape('Circle', 'circle', 1, WHITE),
      words(welcomeFor(robots), 5, LETTERS),
      shape('Heart', 'heart', 3, PINK),
    ],
  },
  {
    id: 'countdown',
    title: 'Countdown',
    face: 0,
    frames: () => [
      words('3', 1, [GOLD]),
      words('2', 1, [ORANGE]),
      words('1', 1, [RED]),
      shape('Star', 'star', 3, WHITE),
    ],
  },
  {
    id: 'heartbeat',
    title: 'Heartbeat',
    face: 1,
    frames: () => [
      shape('Beat', 'heart', 0.3, RED),
      shape('Beat', 'heart', 0.3, PINK, {}, 1.3),
      shape('Rest', 'heart', 1, RED),
      shape('Beat', 'heart', 0.3, PINK, {}, 1.3),
      shape('Rest', 'heart', 2, RED),
    ],
  },
  {
    id: 'star-to-heart',
    title: 'Star to heart',
    face: 0,
    frames: () => [
      shape('Star', 'star', 3, GOLD),
      shape('Heart', 'heart', 3, RED),
      shape('Circle', 'circle', 2, BLUE),
    ],
  },
  {
    id: 'galaxy',
    title: 'Galaxy',
    face: 0,
    frames: (robots) =>
      [VIOLET, BLUE, WHITE, BLUE].map((color, nth) =>
        shape('Galaxy', 'spiral', 1, color, { turns: turnsFor(robots), turn: nth * QUARTER }),
      ),
  },
  {
    id: 'waves',
    title: 'Waves',
    face: 0,
    frames: () =>
      [TEAL, BLUE, TEAL, BLUE].map((color, nth) =>
        shape('Wave', 'wave', 1, color, { turns: 2, turn: (nth % 2) * Math.PI }),
      ),
  },
  {
    id: 'grid-to-ring',
    title: 'Grid to ring',
    face: 1,
    frames: () => [
      shape('Grid', 'grid', 2, WHITE),
      shape('Ring', 'circle', 2, GOLD, { style: 'outline' }),
      shape('Rings', 'rings', 2, ORANGE, { count: 2 }),
      shape('Honeycomb', 'hexagons', 2, GOLD),
    ],
  },
  {
    id: 'firework',
    title: 'Firework',
    face: 1,
    frames: (robots) => [
      shape('Rocket', 'hexagons', 1, WHITE),
      shape('Burst', 'rings', 0.5, GOLD, { count: ringsFor(robots) }),
      shape('Sparks', 'random', 2, PINK, {}, 1.5),
    ],
  },
  {
    id: 'sunrise',
    title: 'Sunrise',
    face: 2,
    frames: () => [
      shape('Horizon', 'rectangle', 1, RED, { aspect: 6 }),
      shape('Sun', 'circle', 2, ORANGE),
      shape('Rays', 'star', 4, GOLD, { count: 12, inner: 0.6 }),
    ],
  },
  {
    id: 'this-way',
    title: 'This way',
    face: 0,
    frames: () =>
      [0, 1, 2, 3].map((nth) =>
        shape('Arrow', 'arrow', 1.5, [GREEN, TEAL, BLUE, VIOLET][nth] ?? GREEN, {
          turn: nth * QUARTER,
        }),
      ),
  },
];

const ringsFor = (robots: number) => Math.max(2, Math.min(5, Math.round(Math.sqrt(robots / 8))));
