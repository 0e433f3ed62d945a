import { toHex, type Rgb } from '../base/colour';
import type { Layer, LayerSettings } from './layers';
import type { Stage } from './show';

/** A layer with a name, made for the floor of a show. */
export interface LightPreset {
  title: string;
  kind: string;
  settings: (floor: Stage) => LayerSettings;
}

const colours = (...all: Rgb[]) => all.map(toHex);
/** Middle of the floor's left edge (`left`) and of its edge nearest to the viewer (`front`), stage metres. */
const left = (floor: Stage) => [-floor.width_m / 2, 0];
const front = (floor: Stage) => [0, -floor.depth_m / 2];
/** Up the floor, away from the viewer; radians. */
const UP = 1.5708;
/** A layer that only dims: the colours of the frame stay. */
const DIMS = { blend: 'multiply' };
/** A layer that only brightens. */
const BRIGHTENS = { blend: 'screen' };

/** Twelve presets. The strobe flashes twice a second: more than three flashes can cause seizures. */
export const LIGHT_PRESETS: readonly LightPreset[] = [
  {
    title: 'Rainbow',
    kind: 'rainbow',
    settings: (floor) => ({ place: left(floor), size_m: floor.width_m, speed_hz: 0.2 }),
  },
  {
    title: 'Sunrise',
    kind: 'gradient',
    settings: (floor) => ({
      palette: colours(0xffd27a, 0xff7a1a, 0xb3245e, 0x23154d),
      place: front(floor),
      angle: UP,
      size_m: floor.depth_m,
      speed_hz: 0.08,
      wrap: 'mirror',
    }),
  },
  {
    title: 'Sea',
    kind: 'noise',
    settings: (floor) => ({
      palette: colours(0x001a4d, 0x005bbb, 0x00b7d8, 0xb6fff2),
      size_m: Math.max(0.5, floor.width_m / 3),
      speed_hz: 0.3,
      octaves: 2,
    }),
  },
  {
    title: 'Northern lights',
    kind: 'plasma',
    settings: (floor) => ({
      palette: colours(0x04122b, 0x00c878, 0x5cffb0, 0x7a2bd6),
      size_m: floor.width_m / 2,
      speed_hz: 0.12,
    }),
  },
  {
    title: 'Fire',
    kind: 'fire',
    settings: (floor) => ({
      palette: colours(0x100000, 0xb01000, 0xff6a00, 0xffd860),
      place: front(floor),
      angle: UP,
      size_m: floor.depth_m,
      speed_hz: 0.8,
    }),
  },
  {
    title: 'Starry',
    kind: 'twinkle',
    settings: () => ({
      palette: colours(0x000000, 0xffffff),
      speed_hz: 0.4,
      density: 0.5,
      ...BRIGHTENS,
    }),
  },
  {
    title: 'Glitter',
    kind: 'sparkle',
    settings: () => ({
      palette: colours(0x000000, 0xffffff),
      speed_hz: 6,
      density: 0.08,
      ...BRIGHTENS,
    }),
  },
  {
    title: 'Chase',
    kind: 'chase',
    settings: (floor) => ({
      palette: colours(0x181818, 0xffffff),
      place: left(floor),
      size_m: floor.width_m,
      speed_hz: 0.5,
      width: 0.6,
      ...DIMS,
    }),
  },
  {
    title: 'Ripple',
    kind: 'ripple',
    settings: (floor) => ({
      palette: colours(0x000000, 0x40c4ff),
      size_m: Math.max(floor.width_m, floor.depth_m) / 2,
      speed_hz: 0.5,
      width: 0.25,
      ...BRIGHTENS,
    }),
  },
  {
    title: 'Breathing',
    kind: 'fade',
    settings: () => ({
      palette: colours(0xffffff, 0x282828),
      speed_hz: 0.4,
      wrap: 'mirror',
      ease: 'sine',
      ...DIMS,
    }),
  },
  {
    title: 'Heartbeat',
    kind: 'pulse',
    settings: () => ({ palette: colours(0x303030, 0xffffff), speed_hz: 1.1, width: 0.2, ...DIMS }),
  },
  {
    title: 'Slow strobe',
    kind: 'strobe',
    settings: () => ({ palette: colours(0x000000, 0xffffff), speed_hz: 2, width: 0.4, ...DIMS }),
  },
];

/** The layer of a preset, over the whole show. */
export const presetLayer = ({ title, kind, settings }: LightPreset, floor: Stage): Layer => ({
  kind,
  name: title,
  settings: settings(floor),
  when: { of: 'show' },
  rest: {},
});
