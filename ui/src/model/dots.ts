import type { Dot } from '../base/geometry';
import type { Frame } from './show';

const NOTHING: readonly never[] = [];
const hollows = new WeakMap<Frame, readonly Dot[]>();

/** A frame's pixels as hollow dots; the same list for the same frame object. Empty without a frame. */
export function hollowOf(frame: Frame | undefined): readonly Dot[] {
  if (!frame) return NOTHING;
  let dots = hollows.get(frame);
  if (!dots) {
    dots = frame.pixels.map((p) => ({ x: p.x, y: p.y, color: p.color, alpha: 0.75 }));
    hollows.set(frame, dots);
  }
  return dots;
}
