import { NO_OVERLAY } from './editorState';
import type { Obstacle, Point } from '../base/geometry';
import { addObstacle, obstacleAt, obstacleBetween, setObstacle, shiftObstacle } from './obstacles';
import type { Show } from './show';
import type { Tool } from './tool';

type Held =
  | { name: 'drawing'; from: Point; before: Show }
  | { name: 'moving'; from: Point; index: number; was: Obstacle };

/** Draws a no-go area, or moves the area under the pointer. Alt draws a disc from its centre, else a rectangle. */
export function createObstacleTool(lengthText: (metres: number) => string): Tool {
  let held: Held | null = null;
  return {
    down(editor, { at }) {
      const { show } = editor.state.get();
      const index = obstacleAt(show.stage.obstacles, at);
      const was = show.stage.obstacles[index];
      editor.begin();
      held = was
        ? { name: 'moving', from: at, index, was }
        : { name: 'drawing', from: at, before: show };
    },
    move(editor, { at, alt }) {
      const now = held;
      if (now?.name === 'moving') {
        const moved = shiftObstacle(now.was, at.x - now.from.x, at.y - now.from.y);
        editor.change('No-go area', (show) => setObstacle(show, now.index, moved));
      } else if (now?.name === 'drawing') {
        const drawn = obstacleBetween(now.from, at, alt);
        editor.change('No-go area', () => (drawn ? addObstacle(now.before, drawn) : now.before));
        const [w, d] = [Math.abs(at.x - now.from.x), Math.abs(at.y - now.from.y)];
        const hint = alt
          ? `radius ${lengthText(Math.hypot(w, d))}`
          : `${lengthText(w)} × ${lengthText(d)}`;
        editor.overlay({ ...NO_OVERLAY, hint });
      }
    },
    up(editor) {
      const label = held?.name === 'moving' ? 'Move no-go area' : 'No-go area';
      held = null;
      editor.commit(label);
    },
    cancel(editor) {
      const busy = held !== null;
      held = null;
      editor.cancel();
      return busy;
    },
  };
}
