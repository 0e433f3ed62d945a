import { boxOf, centreOf, type Point } from '../base/geometry';
import { NO_OVERLAY } from './editorState';
import type { Motion, Pair } from './motion';
import type { Frame } from './show';
import type { Tool, Touch } from './tool';

/** A motion, and the frame before it, with the picture that it moves. */
export interface ShownMotion {
  motion: Motion;
  before: Frame;
}

/** Where the points of a motion's curve count from, stage metres: for `travel` the picture's centre, else 0, 0. */
export function originOf({ motion, before }: ShownMotion): Point {
  return motion.kind === 'travel' ? centreOf(boxOf(before.pixels)) : { x: 0, y: 0 };
}

/** The handles of a motion, stage metres: the points of its curve, or its centre; none for other kinds. */
export function motionGrips(shown: ShownMotion): Point[] {
  const { motion } = shown;
  const origin = originOf(shown);
  switch (motion.kind) {
    case 'travel':
    case 'follow':
      return motion.along.map(([x, y]) => ({ x: origin.x + x, y: origin.y + y }));
    case 'turn':
    case 'breathe':
      return [{ x: motion.center[0], y: motion.center[1] }];
    default:
      return [];
  }
}

/** Index of the handle under a pointer, the last of several; null: there is none. */
export function motionGripAt(shown: ShownMotion, { at, reach_m }: Touch): number | null {
  const grips = motionGrips(shown);
  const nth = grips.findLastIndex((grip) => Math.hypot(grip.x - at.x, grip.y - at.y) <= reach_m);
  return nth < 0 ? null : nth;
}

/** The motion with handle `nth` at a place, stage metres, rounded to a millimetre. */
export function withGrip(shown: ShownMotion, nth: number, at: Point): Motion {
  const { motion } = shown;
  const origin = originOf(shown);
  const place: Pair = [rounded(at.x - origin.x), rounded(at.y - origin.y)];
  switch (motion.kind) {
    case 'travel':
    case 'follow':
      return { ...motion, along: motion.along.map((one, i) => (i === nth ? place : one)) };
    case 'turn':
    case 'breathe':
      return { ...motion, center: place };
    default:
      return motion;
  }
}

/** Drags a handle of a motion. `draw` shows the changed motion meanwhile, null: the drag is over; `done` takes it. */
export function createMotionTool(
  shown: ShownMotion,
  nth: number,
  lengthText: (m: number) => string,
  draw: (motion: Motion | null) => void,
  done: (motion: Motion) => void,
): Tool {
  let changed: Motion | null = null;
  let isHeld = false;
  return {
    down() {
      isHeld = true;
    },
    move(editor, { at }) {
      changed = withGrip(shown, nth, at);
      draw(changed);
      editor.overlay({ ...NO_OVERLAY, hint: `${lengthText(at.x)}, ${lengthText(at.y)}` });
    },
    up(editor) {
      isHeld = false;
      draw(null);
      editor.overlay(NO_OVERLAY);
      if (changed) done(changed);
    },
    cancel(editor) {
      const busy = isHeld;
      isHeld = false;
      changed = null;
      draw(null);
      editor.overlay(NO_OVERLAY);
      return busy;
    },
  };
}

/** Metres rounded to a millimetre. */
const rounded = (metres: number) => Math.round(metres * 1e3) / 1e3 + 0;
