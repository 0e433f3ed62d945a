import type { LightRequest } from '../api/types.gen';
import { writeShow } from '../model/json';
import { withLayers, type Layer } from '../model/layers';
import { newFrame, type Pixel, type Show, type Stage } from '../model/show';

/** A floor full of robots over `STRIP_MOMENTS`: moment by moment red, green and blue of each, in rows from the back. */
export type Strip = Uint8Array;

/** Robots side by side, along x. */
export const STRIP_COLUMNS = 12;
/** Robots one behind the other, along y. */
export const STRIP_ROWS = 8;
export const STRIP_ROBOTS = STRIP_COLUMNS * STRIP_ROWS;
/** The moments of a strip, seconds: 4 s at 20 a second. */
export const STRIP_MOMENTS = { from_s: 0, step_s: 0.05, count: 80 } as const;

/** Colour of the robots' pixels in the frame that is shown. */
const OWN = 0x7a5a30;
/** Colour of their pixels in the next frame, for layers that use it. */
const NEXT = 0x18a0ff;

/** A request with this layer alone, over a whole show of robots that stand all over the floor. */
export function stripRequest(layer: Layer, stage: Stage): LightRequest {
  const place = (cells: number, nth: number, extent_m: number) =>
    ((nth + 0.5) / cells - 0.5) * extent_m;
  const pixels = (color: number): Pixel[] =>
    Array.from({ length: STRIP_ROBOTS }, (_, id) => ({
      id,
      x: place(STRIP_COLUMNS, id % STRIP_COLUMNS, stage.width_m),
      y: -place(STRIP_ROWS, Math.floor(id / STRIP_COLUMNS), stage.depth_m),
      color,
      robot: null,
      part: null,
      group: null,
    }));
  const frame = (color: number) => ({ ...newFrame('', pixels(color)), airTime_s: 60 });
  const show: Show = {
    name: '',
    stage: { ...stage, obstacles: [] },
    identity: 'fixed',
    music: null,
    frames: [frame(OWN), frame(NEXT)],
    rest: {},
  };
  const alone = withLayers(show, [{ ...layer, when: { of: 'show' } }]);
  return { show: writeShow(alone), transitions: [] };
}
