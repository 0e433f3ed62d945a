import type { Point } from '../base/geometry';
import type { Editor } from './editor';

/** A pointer on the stage, stage metres. */
export interface Touch {
  at: Point;
  /** Distance by which a click may miss, metres; depends on the zoom. */
  reach_m: number;
  shift: boolean;
  alt: boolean;
  ctrl: boolean;
  /** The second press of a double click. */
  again: boolean;
}

/** A small state machine for one gesture at a time, from `down` to `up`. */
export interface Tool {
  down(editor: Editor, touch: Touch): void;
  move(editor: Editor, touch: Touch): void;
  up(editor: Editor, touch: Touch): void;
  /** Cancels the gesture and takes its changes back; answers whether there was a gesture. */
  cancel(editor: Editor): boolean;
}

/** Id of the pixel nearest to a pointer, within the robot's radius or the pointer's reach, whichever is larger. */
export function pixelAt(editor: Editor, touch: Touch): number | null {
  const radius = editor.state.get().show.stage.radius_m;
  let [best, distance] = [null as number | null, Math.max(radius, touch.reach_m)];
  for (const p of editor.current()?.pixels ?? []) {
    const d = Math.hypot(p.x - touch.at.x, p.y - touch.at.y);
    if (d <= distance) [best, distance] = [p.id, d];
  }
  return best;
}
