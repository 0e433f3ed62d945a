import { motionGrips, originOf, type ShownMotion } from '../../model/motionTool';
import type { EditorState } from '../../model/editorState';
import type { Motion } from '../../model/motion';
import { canvasFromStage, type Camera } from '../../stage/camera';
import type { Editing } from '../editing';
import { beginHandles, dashedLine, roundHandle } from '../handlePaint';

/** The motion of the frame on the stage, if its settings are open; null: none. `drawn` replaces it during a drag. */
export function shownMotion(
  { show, frame }: EditorState,
  isOpen: boolean,
  drawn: Motion | null,
): ShownMotion | null {
  const [before, motion] = [show.frames[frame - 1], drawn ?? show.frames[frame]?.motion];
  return isOpen && before && motion ? { motion, before } : null;
}

/** The motion with handles that a pointer may take: that of the frame, with the arrow tool; null: none. */
export const motionAtHand = ({ editor, moving, tool }: Editing) =>
  tool.get() === 'arrow' ? shownMotion(editor.state.get(), moving.get(), null) : null;

/** Draws the curve of a motion and its handles. */
export function paintMotion(c: CanvasRenderingContext2D, camera: Camera, shown: ShownMotion) {
  const grips = motionGrips(shown).map((at) => canvasFromStage(camera, at));
  const begin = shown.motion.kind === 'travel' ? [canvasFromStage(camera, originOf(shown))] : [];
  beginHandles(c);
  dashedLine(c, [...begin, ...grips]);
  grips.forEach((grip) => roundHandle(c, grip));
}
