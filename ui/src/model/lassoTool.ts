import { NO_OVERLAY } from './editorState';
import { type Point, inPolygon } from '../base/geometry';
import { pixelAt, type Tool } from './tool';

/** Most corners of a lasso; after that the last corner follows the pointer. */
const CORNERS_MAX = 2000;

/** Selects the pixels inside a freehand line; a click selects one pixel or none. Shift adds to the selection. */
export function createLassoTool(): Tool {
  let line: Point[] | null = null;
  let before: ReadonlySet<number> = new Set();
  return {
    down(editor, touch) {
      before = touch.shift ? editor.state.get().selection : new Set();
      line = [touch.at];
    },
    move(editor, touch) {
      if (!line) return;
      if (line.length < CORNERS_MAX) line.push(touch.at);
      else line[CORNERS_MAX - 1] = touch.at;
      const corners = line;
      const inside = editor.current()?.pixels.filter((p) => inPolygon(p, corners)) ?? [];
      editor.select([...before, ...inside.map((p) => p.id)]);
      editor.overlay({ ...NO_OVERLAY, marquee: [...corners] });
    },
    up(editor, touch) {
      const hit = line && line.length < 3 ? pixelAt(editor, touch) : null;
      if (line && line.length < 3) editor.select(hit === null ? before : [...before, hit]);
      line = null;
      editor.overlay(NO_OVERLAY);
    },
    cancel(editor) {
      const busy = line !== null;
      if (busy) editor.select(before);
      line = null;
      editor.overlay(NO_OVERLAY);
      return busy;
    },
  };
}
