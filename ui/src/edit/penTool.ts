import type { Point } from '../base/geometry';
import type { Draft } from '../make/draft';
import {
  APART_M,
  insertPoint,
  middles,
  removePoint,
  simplified,
  withPoint,
} from '../make/drawnLine';
import type { Making } from '../make/making';
import { choosePoint, penLine, setPoints, stopAdding, type PenLine } from '../make/pen';
import { NO_OVERLAY } from '../model/editorState';
import type { Editor } from '../model/editor';
import type { Tool, Touch } from '../model/tool';

/** What a press with the pen does; `index`: of the point that is taken, or of the new one. */
type Press =
  | { does: 'point'; index: number }
  | { does: 'insert'; index: number }
  | { does: 'append' }
  | { does: 'stroke' };

/** What a press does to the line that is made; null: nothing, the press may mean something else. */
function pressOn(line: PenLine, touch: Touch): Press | null {
  const isNear = (p: Point) =>
    Math.hypot(p.x - touch.at.x, p.y - touch.at.y) < Math.max(touch.reach_m, APART_M);
  if (line.kind === 'freehand' && line.isDrawing) return { does: 'stroke' };
  // Of two points at one place, the later one lies above.
  const index = line.points.findLastIndex(isNear);
  if (index >= 0) return { does: 'point', index };
  if (line.isDrawing) return { does: 'append' };
  const middle =
    line.kind === 'line'
      ? undefined
      : middles(line.points, line.closed).find(({ at }) => isNear(at));
  return middle ? { does: 'insert', index: middle.index } : null;
}

/** The pen for a press on the stage; null: no line is drawn, or the press is not on it. */
export function penFor(making: Making, touch: Touch): Tool | null {
  const line = penLine(making);
  const press = line && pressOn(line, touch);
  return press && createPenTool(making, press);
}

interface Held {
  before: Draft;
  /** Index of the point that follows the pointer; null: a stroke. `points`: all points, of a stroke those until now. */
  index: number | null;
  points: readonly Point[];
}

function createPenTool(making: Making, press: Press): Tool {
  let held: Held | null = null;
  const floor = (editor: Editor) => {
    const { width_m, depth_m, radius_m } = editor.state.get().show.stage;
    return { width_m, depth_m, radius_m };
  };
  const end = (editor: Editor) => {
    held = null;
    editor.commit('Make');
  };
  return {
    down(editor, touch) {
      const line = penLine(making);
      if (!line) return;
      const before = making.draft.get();
      editor.begin();
      if (press.does === 'stroke') {
        held = { before, index: null, points: [touch.at] };
        return;
      }
      if (press.does === 'point' && isAct(making, line, press.index, touch, floor(editor))) {
        end(editor);
        return;
      }
      const index = press.does === 'append' ? line.points.length : press.index;
      const points =
        press.does === 'point' ? line.points : insertPoint(line.points, index, touch.at);
      held = { before, index, points };
      const more = line.kind === 'polyline' || line.kind === 'curve';
      making.pen.set({
        isAdding: press.does === 'append' ? more : making.pen.get().isAdding,
        point: index,
      });
      if (press.does !== 'point') setPoints(making, points, floor(editor));
    },
    move(editor, { at }) {
      if (!held) return;
      if (held.index === null) {
        const last = held.points.at(-1);
        if (last && Math.hypot(at.x - last.x, at.y - last.y) < APART_M) return;
        held = { ...held, points: [...held.points, at] };
        setPoints(making, simplified(held.points), floor(editor));
        return;
      }
      const { points } = held;
      // A drag that begins with the first point adds a second one, which follows the pointer.
      const isFirst = points.length === 1 && press.does === 'append';
      if (isFirst && isSame(points[0], at)) return;
      const moved = isFirst ? [...points, at] : withPoint(points, held.index, at);
      setPoints(making, moved, floor(editor));
      if (isFirst) choosePoint(making, 1);
    },
    up(editor) {
      if (held) end(editor);
    },
    cancel(editor) {
      const before = held?.before;
      held = null;
      editor.cancel();
      if (before) {
        const { points, closed, center, size_m, turn } = before;
        making.change({ points, closed, center, size_m, turn });
      }
      editor.overlay(NO_OVERLAY);
      return before !== undefined;
    },
  };
}

const isSame = (a: Point | undefined, b: Point) =>
  a !== undefined && Math.hypot(a.x - b.x, a.y - b.y) < APART_M;

/**
 * Does what a press on a point does by itself, and answers whether it did something. While points are added, a press
 * on the first of at least three closes the line, and a double click ends it. Later a double click removes a point.
 */
function isAct(
  making: Making,
  { points, kind, isDrawing }: PenLine,
  index: number,
  { again }: Touch,
  floor: Parameters<typeof setPoints>[2],
): boolean {
  if (isDrawing) {
    const closes = index === 0 && points.length > 2 && kind !== 'line';
    if (closes) making.change({ closed: true });
    return (again || closes) && points.length > 1 && (stopAdding(making), true);
  }
  if (!again || points.length < 3) return false;
  setPoints(making, removePoint(points, index), floor);
  choosePoint(making, null);
  return true;
}
