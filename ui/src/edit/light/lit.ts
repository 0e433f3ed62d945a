import type { Plan, Transition } from '../../api/types.gen';
import { rgb, type Rgb } from '../../base/colour';
import type { Dot } from '../../base/geometry';
import type { Colours } from '../../light/lights';
import { layersOf, type Layer } from '../../model/layers';
import type { Frame, Pixel, Show } from '../../model/show';
import { timelineOf } from '../../model/timeline';
import type { Editing } from '../editing';

const NOTHING: readonly Transition[] = [];

/** Least air time with which the frame on the stage is lit, seconds: in a short one many effects hardly begin. */
const STANDS_S = 60;

let standing: { frames: readonly Frame[]; frame: number; made: readonly Frame[] } | null = null;

/** The show with frame `frame` standing for at least `STANDS_S`; the same list of frames as in the last such call. */
function withLongFrame(show: Show, frame: number): Show {
  if (standing?.frames !== show.frames || standing.frame !== frame) {
    const made = show.frames.map((one, i) =>
      i === frame ? { ...one, airTime_s: Math.max(one.airTime_s, STANDS_S) } : one,
    );
    standing = { frames: show.frames, frame, made };
  }
  return { ...show, frames: standing.made };
}

/**
 * The robots' colours at `time_s`, seconds from the start of the first drive. With null: of the frame on the stage
 * while the panel of layers is open, as if it stood for long, over and over. The answer is null without colours.
 */
export function litNow(
  editing: Editing,
  plan: Plan | null,
  time_s: number | null,
  now_ms: number,
): Colours | null {
  const { show, frame } = editing.editor.state.get();
  const transitions = plan?.transitions ?? NOTHING;
  if (time_s !== null) return editing.lights.at(show, transitions, time_s);
  if (!editing.lighting.get()) return null;
  const long = withLongFrame(show, frame);
  const segment = timelineOf(long, plan)[frame];
  if (!segment) return null;
  const into_s = (now_ms / 1000) % (segment.until_s - segment.shownFrom_s);
  return editing.lights.at(long, transitions, segment.shownFrom_s + into_s);
}

/** The chosen layer, with its index, while the panel of layers is open; null: none. */
export function shownLayer(editing: Editing): { index: number; layer: Layer } | null {
  const index = editing.lighting.get() ? editing.layer.get() : null;
  const layer = index === null ? undefined : layersOf(editing.editor.state.get().show)[index];
  return index !== null && layer ? { index, layer } : null;
}

const colourAt = (lit: Colours, robot: number, otherwise: Rgb): Rgb => {
  const [r, g, b] = [lit[3 * robot], lit[3 * robot + 1], lit[3 * robot + 2]];
  return r === undefined || g === undefined || b === undefined ? otherwise : rgb(r, g, b);
};

/** Dots of robots, in the order of the plan, with their colours from `lit`; null leaves them as they are. */
export const litDots = (dots: Dot[], lit: Colours | null): Dot[] =>
  lit ? dots.map((dot, robot) => ({ ...dot, color: colourAt(lit, robot, dot.color) })) : dots;

/** A frame's pixels as dots, each in the colour of its robot by `drive`; without paths the n-th pixel is robot n. */
export function litPixels(
  pixels: readonly Pixel[],
  drive: Transition | undefined,
  lit: Colours | null,
): Dot[] {
  const robots =
    lit && drive && drive.paths.length > 0
      ? new Map(drive.pixels.map((pixel, robot) => [pixel, robot]))
      : null;
  return pixels.map(({ x, y, color, id }, nth) => {
    const robot = robots ? robots.get(id) : nth;
    const own = lit && robot !== undefined ? colourAt(lit, robot, color) : color;
    return { x, y, color: own, alpha: 1 };
  });
}
