import type { MakeAnswer, MakeQuality } from '../api/types.gen';
import { EMPTY_STAGE, newFrame, type Frame, type Stage } from '../model/show';
import { pixelsOf, requestOf } from './frame';
import type { Maker } from './maker';
import type { TemplateFrame } from './templates';

/** A frame of a template with its pixels, and the answer of the module, which may be an error. */
export interface MadeTemplateFrame {
  frame: Frame;
  answer: MakeAnswer;
}

/** Share of the floor's shorter side that an enlarged picture (`grown` above 1) may take. */
const ROOM = 0.86;

/** Robots up to which every template has room on a floor of 3 m by 3 m: WELCOME has room for 73, the module said. */
const ROBOTS_USUAL_FLOOR = 70;

/** The floor of a new show: 3 m by 3 m for up to `ROBOTS_USUAL_FLOOR` robots, larger for more, in steps of 0.5 m. */
export function floorFor(robots: number): Stage {
  const side_m = Math.ceil(3 * Math.sqrt(Math.max(1, robots / ROBOTS_USUAL_FLOOR)) * 2) / 2;
  return { ...EMPTY_STAGE, width_m: side_m, depth_m: side_m };
}

/** Makes one frame of a template; null: a newer request replaced this one. */
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

/** Metres rounded to a centimetre: a finer difference of sizes is not seen. */
const round = (m: number) => Math.round(m * 100) / 100;

/** Makes all frames of a template; throws if one cannot be made. `told` gets the number of frames made, after each. */
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
