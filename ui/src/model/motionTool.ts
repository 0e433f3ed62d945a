import { boxOf, centreOf, type Point } from '../base/geometry';
import { NO_OVERLAY } from './editorState';
import type { Motion, Pair } from './motion';
import type { Frame } from './show';
import type { Tool, Touch } from './tool';

/** A motion and the picture that it moves. */
export interface ShownMotion {
  motion: Motion;
  before: Frame;
}

/** Where the offsets of a motion count from, stage metres. */
export function originOf({ motion, before }: ShownMotion): Point {
  return motion.kind === 'travel' ? centreOf(boxOf(before.pixels)) : { x: 0, y: 0 };
}

/** The handles of a motion, stage metres: the points of its curve, or its centre. */
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

/** The number of the handle under a pointer; null: there is none. */
export function motionGripAt(shown: ShownMotion, { at, reach_m }: Touch): number | null {
  const grips = motionGrips(shown);
  const nth = grips.findLastIndex((grip) => Math.hypot(grip.x - at.x, grip.y - at.y) <= reach_m);
  return nth < 0 ? null : nth;
}

/** The motion with one of its handles at a place. */
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

/** Drags a handle of a motion. `draw` shows the motion meanwhile, null: as it is; `done` takes it. */
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

/** To a millimetre. */
const rounded = (metres: number) => Math.round(metres * 1e3) / 1e3 + 0;
