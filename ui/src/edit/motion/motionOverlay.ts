import { motionGrips, originOf, type ShownMotion } from '../../model/motionTool';
import type { EditorState } from '../../model/editorState';
import type { Motion } from '../../model/motion';
import { canvasFromStage, type Camera } from '../../stage/camera';
import { FLOOR } from '../../stage/palette';
import type { Editing } from '../editing';

const DOT_PX = 6;

/** The motion whose handles the stage shows; null: none. `drawn`: as it is while a handle is dragged. */
export function shownMotion(
  { show, frame }: EditorState,
  isOpen: boolean,
  drawn: Motion | null,
): ShownMotion | null {
  const [before, motion] = [show.frames[frame - 1], drawn ?? show.frames[frame]?.motion];
  return isOpen && before && motion ? { motion, before } : null;
}

/** The motion whose handles a pointer may take. */
export const motionAtHand = ({ editor, moving, tool }: Editing) =>
  tool.get() === 'arrow' ? shownMotion(editor.state.get(), moving.get(), null) : null;

/** Draws the curve of a motion and its handles. */
export function paintMotion(c: CanvasRenderingContext2D, camera: Camera, shown: ShownMotion) {
  const grips = motionGrips(shown).map((at) => canvasFromStage(camera, at));
  const begin = shown.motion.kind === 'travel' ? [canvasFromStage(camera, originOf(shown))] : [];
  c.strokeStyle = FLOOR.chosen;
  c.fillStyle = FLOOR.plate;
  c.lineWidth = 1.5;
  c.setLineDash([5, 4]);
  c.beginPath();
  [...begin, ...grips].forEach(({ x, y }, i) => (i === 0 ? c.moveTo(x, y) : c.lineTo(x, y)));
  c.stroke();
  c.setLineDash([]);
  for (const { x, y } of grips) {
    c.beginPath();
    c.arc(x, y, DOT_PX, 0, 2 * Math.PI);
    c.fill();
    c.stroke();
  }
}
