import { NO_OVERLAY } from './editorState';
import { type Box, type Point, boxOf, centreOf, rotate, scaleAbout } from '../base/geometry';
import { placePixels } from './commands';
import { type Editor } from './editor';
import type { Tool } from './tool';

/** A handle of the box around the selection: a corner, a side, or the knob that turns the box. */
export type Handle = { kind: 'turn' } | { kind: 'scale'; sx: -1 | 0 | 1; sy: -1 | 0 | 1 };

/** A box with a side shorter than this is not scaled along that side, metres. */
const SIDE_MIN = 1e-4;

/**
 * Turns or scales the selection. Turning: about the centre; Shift: in steps of 15°. Scaling: about the opposite side,
 * with Alt about the centre. A corner scales both axes alike unless Ctrl is held; Shift makes a side do so too.
 */
export function createTransformTool(handle: Handle): Tool {
  let from: { at: Point; box: Box; places: ReadonlyMap<number, Point> } | null = null;

  const apply = (editor: Editor, change: (p: Point) => Point, hint: string) => {
    if (!from) return;
    const places = new Map([...from.places].map(([id, p]) => [id, change(p)]));
    editor.change('Transform', (show, s) => placePixels(show, s.frame, places));
    editor.overlay({ ...NO_OVERLAY, hint });
  };

  return {
    down(editor, touch) {
      const pixels = editor.chosenPixels();
      from = {
        at: touch.at,
        box: boxOf(pixels),
        places: new Map(pixels.map((p) => [p.id, { x: p.x, y: p.y }])),
      };
      editor.begin();
    },
    move(editor, touch) {
      if (!from) return;
      const { box, at } = from;
      const c = centreOf(box);
      if (handle.kind === 'turn') {
        let angle =
          Math.atan2(touch.at.y - c.y, touch.at.x - c.x) - Math.atan2(at.y - c.y, at.x - c.x);
        const step = Math.PI / 12;
        if (touch.shift) angle = Math.round(angle / step) * step;
        const degrees = Math.round((Math.atan2(Math.sin(angle), Math.cos(angle)) * 180) / Math.PI);
        apply(editor, (p) => rotate(p, c, angle), `${degrees}°`);
        return;
      }
      const about = touch.alt ? c : opposite(box, handle.sx, handle.sy);
      let kx = factor(handle.sx, at.x, touch.at.x, about.x);
      let ky = factor(handle.sy, at.y, touch.at.y, about.y);
      if (touch.shift || (handle.sx !== 0 && handle.sy !== 0 && !touch.ctrl))
        kx = ky = handle.sx === 0 ? ky : handle.sy === 0 ? kx : Math.max(kx, ky);
      apply(editor, (p) => scaleAbout(p, about, kx, ky), `${Math.round(Math.max(kx, ky) * 100)} %`);
    },
    up(editor) {
      from = null;
      editor.commit(handle.kind === 'turn' ? 'Turn' : 'Scale');
    },
    cancel(editor) {
      const busy = from !== null;
      from = null;
      editor.cancel();
      return busy;
    },
  };
}

const opposite = (box: Box, sx: number, sy: number): Point => {
  const c = centreOf(box);
  return {
    x: sx === 0 ? c.x : sx > 0 ? box.minX : box.maxX,
    y: sy === 0 ? c.y : sy > 0 ? box.minY : box.maxY,
  };
};

function factor(side: number, from: number, to: number, about: number): number {
  const length = from - about;
  if (side === 0 || Math.abs(length) < SIDE_MIN) return 1;
  return Math.max(0.05, (to - about) / length);
}
