import type { MakeAnswer, MakeQuality, MakeRequest } from '../api/types.gen';
import { fromHex } from '../base/colour';
import { writeShow } from '../model/json';
import type { Frame, Pixel, Show } from '../model/show';
import type { FrameSource } from '../model/sources';

/** A request to make a frame's pixels from a source; pixels in the source's `moved` keep their places. */
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

/** The frame with this source alone, without what making does not need. */
const withSource = (frame: Frame, source: FrameSource): Frame => ({
  ...frame,
  id: null,
  at_s: null,
  rest: {},
  // The file's bytes are passed beside the request.
  sources: [{ ...source, asset: null }],
});

/** The pixels of an answer, as a frame has them. */
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
