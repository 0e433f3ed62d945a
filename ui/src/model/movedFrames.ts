import { boxOf, centreOf, type Point } from '../base/geometry';
import { isOfFormation, type Motion, type MotionKind, type Pair } from './motion';
import type { Frame, Pixel, Show } from './show';

/** A motion with settings that suit a picture; null for `morph`, which needs pictures. */
export function usualMotion(kind: MotionKind, before: Frame): Motion | null {
  const box = boxOf(before.pixels);
  const middle = centreOf(box);
  const center: Pair = [tidy(middle.x), tidy(middle.y)];
  switch (kind) {
    case 'travel':
      return { kind, along: [[tidy(-Math.sign(middle.x || -1) * 0.3), 0]] };
    case 'turn':
      return { kind, center, turn: Math.PI / 2, size: 1 };
    case 'breathe':
      return { kind, center, size: 1.25, times: 1 };
    case 'follow':
      return { kind, along: followOut(before.pixels, middle) };
    case 'wave':
      return { kind, radius_m: 0.04, direction: 0, length_m: 1, times: 2 };
    case 'stagger':
      return { kind, direction: 0, delay_s: 1.5 };
    case 'morph':
      return null;
  }
}

/** A first curve for `follow`, stage metres: from the rightmost pixel outwards and back towards the middle. */
function followOut(pixels: readonly Pixel[], middle: Point): Pair[] {
  const first = pixels.reduce((most, p) => (p.x > most.x ? p : most), { x: -Infinity, y: 0 });
  if (first.x === -Infinity) return [[0, 0]];
  return [
    [tidy(first.x), tidy(first.y)],
    [tidy(first.x + 0.15), tidy(first.y + 0.15)],
    [tidy(middle.x), tidy(first.y + 0.4)],
  ];
}

/** Metres rounded to a millimetre. */
const tidy = (metres: number) => Math.round(metres * 1e3) / 1e3 + 0;

/** Places of pixels by their ids, stage metres. */
export type MovedPlaces = ReadonlyMap<number, Point>;

/**
 * Gives the frame with `key` a motion; null: none. The first frame gets none. For a motion of a formation, the frame
 * takes the pixels of the frame before, at the places of `moved`. They keep the colours of the frame's own pixels.
 */
export function setMotion(
  show: Show,
  key: number,
  motion: Motion | null,
  moved: MovedPlaces | null,
): Show {
  const index = show.frames.findIndex((frame) => frame.key === key);
  const [before, frame] = [show.frames[index - 1], show.frames[index]];
  if (!frame || !before) return show;
  const placed =
    moved && motion && isOfFormation(motion) ? movedFrame(before, frame, moved) : frame;
  const changed = { ...placed, motion };
  return { ...show, frames: show.frames.map((one, i) => (i === index ? changed : one)) };
}

function movedFrame(before: Frame, frame: Frame, moved: MovedPlaces): Frame {
  const colours = new Map(frame.pixels.map((pixel) => [pixel.id, pixel.color]));
  const pixels = before.pixels.map((pixel) => ({
    ...pixel,
    ...moved.get(pixel.id),
    color: colours.get(pixel.id) ?? pixel.color,
    part: null,
  }));
  return { ...frame, sources: [], pixels };
}
