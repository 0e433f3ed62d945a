import type { MakeAnswer, MakeQuality, MakeRequest } from '../api/types.gen';
import { fromHex } from '../base/colour';
import { writeShow } from '../model/json';
import type { Frame, Pixel, Show } from '../model/show';
import type { FrameSource } from '../model/sources';

/** The wish for a frame from a source; pixels of `moved` keep their places. */
export const requestOf = (
  show: Show,
  frame: Frame,
  source: FrameSource,
  robots: number,
  quality: MakeQuality,
): MakeRequest => ({
  // Only the floor and this frame count.
  show: writeShow({
    name: '',
    stage: show.stage,
    identity: 'any',
    music: null,
    frames: [withSource(frame, source)],
    rest: {},
  }),
  robots,
  quality,
});

/** The frame alone; pixels that are placed anew are only needed for their pins. */
const withSource = (frame: Frame, source: FrameSource): Frame => ({
  ...frame,
  id: null,
  at_s: null,
  rest: {},
  // The file goes beside the request.
  sources: [{ ...source, asset: null }],
});

/** The pixels of an answer. */
export const pixelsOf = (answer: MakeAnswer): Pixel[] =>
  answer.pixels.map((made) => ({
    id: made.id,
    x: made.place[0],
    y: made.place[1],
    color: fromHex(made.color) ?? 0xffffff,
    robot: made.robot,
    part: made.part === null ? null : { source: 0, name: made.part },
    group: null,
  }));
