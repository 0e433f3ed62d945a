import type { MakeAnswer, MakeQuality } from '../api/types.gen';
import { EMPTY_STAGE, newFrame, type Frame, type Stage } from '../model/show';
import { pixelsOf, requestOf } from './frame';
import type { Maker } from './maker';
import type { TemplateFrame } from './templates';

/** A frame of a template with its pixels, or why there are none. */
export interface MadeTemplateFrame {
  frame: Frame;
  answer: MakeAnswer;
}

/** Share of the shorter side of the floor that a grown picture may take. */
const ROOM = 0.86;

/** Most robots that find room for every template on a floor of 3 m by 3 m: 73 for WELCOME, the module said. */
const ROBOTS_USUAL_FLOOR = 70;

/** The floor of a new show: 3 m by 3 m, and larger for fleets that find no room there. */
export function floorFor(robots: number): Stage {
  const side_m = Math.ceil(3 * Math.sqrt(Math.max(1, robots / ROBOTS_USUAL_FLOOR)) * 2) / 2;
  return { ...EMPTY_STAGE, width_m: side_m, depth_m: side_m };
}

/** Makes one frame of a template; null: a newer wish came. */
export async function makeTemplateFrame(
  maker: Maker,
  wanted: TemplateFrame,
  robots: number,
  stage: Stage,
  quality: MakeQuality,
): Promise<MadeTemplateFrame | null> {
  const empty = { ...newFrame(wanted.name, []), airTime_s: wanted.airTime_s };
  const show = { name: '', stage, identity: 'any', music: null, frames: [], rest: {} } as const;
  const make = (source: TemplateFrame['source'], how: MakeQuality) =>
    maker.make(requestOf(show, empty, source, robots, how), null);
  let { source } = wanted;
  if (wanted.grown !== 1) {
    const itself = await make(source, 'quick');
    if (!itself) return null;
    const size_m = Math.min(
      itself.size_m * wanted.grown,
      ROOM * Math.min(stage.width_m, stage.depth_m),
    );
    if (size_m > itself.size_m)
      source = { ...source, settings: { ...source.settings, size_m: round(size_m) } };
  }
  const answer = await make(source, quality);
  return answer && { frame: { ...empty, sources: [source], pixels: pixelsOf(answer) }, answer };
}

/** To a centimetre: a finer difference of sizes is not seen. */
const round = (m: number) => Math.round(m * 100) / 100;

/** Makes all frames; an error says which frame cannot be made and why. `told` hears how many frames are made. */
export async function makeTemplate(
  maker: Maker,
  frames: readonly TemplateFrame[],
  robots: number,
  stage: Stage,
  told: (made: number) => void,
): Promise<Frame[]> {
  const all: Frame[] = [];
  for (const wanted of frames) {
    const made = await makeTemplateFrame(maker, wanted, robots, stage, 'full');
    if (!made) throw new Error('The frames were not made.');
    if (made.answer.error) throw new Error(`${wanted.name}: ${made.answer.error.message}`);
    all.push(made.frame);
    told(all.length);
  }
  return all;
}
