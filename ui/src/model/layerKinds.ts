import type { Rgb } from '../base/colour';
import { fromHex, toHex } from '../base/colour';
import type { Point } from '../base/geometry';
import { list, number, object, pair, text } from './jsonFields';
import type { Layer, LayerSettings } from './layers';

/** Settings that a panel has a field for. */
export type LayerSetting =
  | 'palette'
  | 'along'
  | 'place'
  | 'angle'
  | 'size_m'
  | 'speed_hz'
  | 'width'
  | 'density'
  | 'saturation'
  | 'octaves'
  | 'top_mps'
  | 'wrap'
  | 'ease'
  | 'seed';

/** An effect: its name for people, and the settings that change it. */
export interface LayerKind {
  title: string;
  settings: readonly LayerSetting[];
}

const SPOT = ['place', 'angle', 'size_m'] as const;
const RAMP = ['along', ...SPOT] as const;

/** The effects in the order of docs/light.md; `picture` and `sequence` need a file. */
export const LAYER_KINDS: Readonly<Record<string, LayerKind>> = {
  solid: { title: 'Plain colour', settings: ['palette'] },
  gradient: { title: 'Gradient', settings: ['palette', ...RAMP, 'speed_hz', 'wrap', 'ease'] },
  fade: { title: 'Fade', settings: ['palette', 'speed_hz', 'wrap', 'ease'] },
  pulse: { title: 'Pulse', settings: ['palette', 'speed_hz', 'width', 'ease'] },
  strobe: { title: 'Strobe', settings: ['palette', 'speed_hz', 'width'] },
  twinkle: { title: 'Twinkle', settings: ['palette', 'speed_hz', 'width', 'density', 'seed'] },
  sparkle: { title: 'Sparkle', settings: ['palette', 'speed_hz', 'density', 'seed'] },
  rainbow: { title: 'Rainbow', settings: [...RAMP, 'speed_hz', 'saturation'] },
  wave: { title: 'Wave', settings: ['palette', ...RAMP, 'speed_hz', 'ease'] },
  chase: { title: 'Chase', settings: ['palette', ...RAMP, 'speed_hz', 'width', 'ease'] },
  ripple: { title: 'Ripple', settings: ['palette', 'place', 'size_m', 'speed_hz', 'width'] },
  plasma: { title: 'Plasma', settings: ['palette', ...SPOT, 'speed_hz', 'seed'] },
  noise: {
    title: 'Clouds',
    settings: ['palette', 'place', 'size_m', 'speed_hz', 'octaves', 'seed'],
  },
  fire: { title: 'Fire', settings: ['palette', ...SPOT, 'speed_hz', 'seed'] },
  picture: { title: 'Picture', settings: [...SPOT, 'speed_hz'] },
  sequence: { title: 'Sequence', settings: [] },
  'next-frame': { title: 'Colours of the next frame', settings: ['speed_hz', 'wrap', 'ease'] },
  'by-robot': { title: 'A colour per robot', settings: ['palette', 'speed_hz', 'wrap', 'seed'] },
  'by-speed': { title: 'By speed', settings: ['palette', 'top_mps', 'ease'] },
};

/** The name of a layer for people: its own, else that of its effect. */
export const titleOf = ({ name, kind }: Layer) => name || (LAYER_KINDS[kind]?.title ?? kind);

/** Whether a setting changes the layer. Place, angle or size do not where what the effect runs along has none. */
export function isUsed({ kind, settings }: Layer, setting: LayerSetting): boolean {
  const isKnown = LAYER_KINDS[kind]?.settings.includes(setting) ?? false;
  const isSpot = SPOT.some((one) => one === setting);
  if (!isKnown || !isSpot || !LAYER_KINDS[kind]?.settings.includes('along')) return isKnown;
  const along = alongOf(settings);
  if (along === 'order' || along === 'curve') return false;
  if (setting === 'angle') return along !== 'distance';
  return setting !== 'size_m' || along !== 'angle';
}

/** What an effect runs along. */
export const ALONGS = ['line', 'distance', 'angle', 'order', 'curve'] as const;
export type Along = (typeof ALONGS)[number];
export const alongOf = (settings: LayerSettings): Along =>
  ALONGS.find((along) => along === settings.along) ?? 'line';

/** Values of numeric settings where a layer does not set them, as in docs/light.md. */
const NUMBERS = {
  angle: 0,
  size_m: 1,
  speed_hz: 0.5,
  width: 0.5,
  saturation: 1,
  octaves: 3,
  top_mps: 0.27,
  seed: 0,
} as const;

export const numberOf = ({ kind, settings }: Layer, name: keyof typeof NUMBERS | 'density') =>
  number(settings[name], name === 'density' ? (kind === 'sparkle' ? 0.1 : 0.5) : NUMBERS[name]);

export const placeOf = ({ settings }: Layer): Point => {
  const [x, y] = pair(settings.place);
  return { x, y };
};

/** Opacity of the layer, 0 to 1, 1 if it is not set; null: it changes over time. */
export const opacityOf = ({ settings }: Layer): number | null =>
  Array.isArray(settings.opacity) ? null : number(settings.opacity, 1);

/** A colour of a palette. */
export interface PaletteColour {
  color: Rgb;
  /** Its position along the palette and its opacity, each 0 to 1; null: the colours are evenly spaced and opaque. */
  stop: { at: number; opacity: number } | null;
}

const USUAL: readonly PaletteColour[] = [
  { color: 0x000000, stop: null },
  { color: 0xffffff, stop: null },
];

export function paletteOf({ settings }: Layer): readonly PaletteColour[] {
  const items = list(settings.palette);
  if (items.length === 0) return USUAL;
  return items.map((item, i) => {
    if (typeof item === 'string') return { color: fromHex(item) ?? 0, stop: null };
    const { at, color, opacity } = object(item);
    const even = i / Math.max(1, items.length - 1);
    return {
      color: fromHex(text(color)) ?? 0,
      stop: { at: number(at, even), opacity: number(opacity, 1) },
    };
  });
}

/** A palette as the document has it: colours alone if no colour has a `stop`. */
export function paletteJson(colours: readonly PaletteColour[]): readonly unknown[] {
  if (colours.every(({ stop }) => stop === null)) return colours.map(({ color }) => toHex(color));
  return colours.map(({ color, stop }, i) => {
    const { at, opacity } = stop ?? { at: i / Math.max(1, colours.length - 1), opacity: 1 };
    return { at, color: toHex(color), ...(opacity === 1 ? {} : { opacity }) };
  });
}
