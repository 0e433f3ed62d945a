import type { Point } from '../base/geometry';
import { noHistory, remember, type History, type Mark } from './history';
import type { Guide } from './snap';
import type { Show } from './show';

export interface EditorState {
  show: Show;
  /** Index of the frame on the stage. */
  frame: number;
  /** Indices of all chosen frames, the one on the stage among them. */
  frames: ReadonlySet<number>;
  /** Index of the frame at which a range of chosen frames begins. */
  anchor: number;
  /** Ids of the chosen pixels; they stay chosen from frame to frame. */
  selection: ReadonlySet<number>;
  history: History<Show>;
  /** What a gesture shows while it lasts: lines, rectangle or lasso. */
  overlay: Overlay;
  /** Counts every change that is worth saving. */
  changes: number;
}

export interface Overlay {
  guides: readonly Guide[];
  marquee: readonly Point[];
  /** Distance or angle of the drag, with its unit. */
  hint: string;
}

export const NO_OVERLAY: Overlay = { guides: [], marquee: [], hint: '' };

/** The state of an editor that has just begun, with a frame of the show on the stage. */
export const firstState = (show: Show, frame: number): EditorState => ({
  show,
  frame: inside(show, frame),
  frames: new Set([inside(show, frame)]),
  anchor: inside(show, frame),
  selection: new Set(),
  history: noHistory(),
  overlay: NO_OVERLAY,
  changes: 0,
});

/** Index of the show's frame nearest to `frame`; 0 without frames. */
const inside = (show: Show, frame: number) => Math.max(0, Math.min(show.frames.length - 1, frame));

/** The state with the chosen frames limited to the frames that the show has. */
export function withinShow(state: EditorState): EditorState {
  const frame = inside(state.show, state.frame);
  const kept = [...state.frames].filter((index) => index < state.show.frames.length);
  const anchor = inside(state.show, state.anchor);
  return { ...state, frame, anchor, frames: new Set(kept.concat(frame)) };
}

/** The state after the change in `mark`, which undo takes back; `toSave` is 0 for a change that is saved already. */
export const withMark = (state: EditorState, mark: Mark<Show>, toSave: 0 | 1 = 1): EditorState =>
  withinShow({
    ...state,
    show: mark.after,
    history: remember(state.history, mark),
    changes: state.changes + toSave,
  });

/** The state with a show from the history, and the frame at index `frame`, or else the last one, on the stage. */
export function withShowOf(
  state: EditorState,
  history: History<Show>,
  show: Show,
  frame: number,
): EditorState {
  const at = Math.min(frame, show.frames.length - 1);
  return withinShow({
    ...state,
    show,
    history,
    frame: at,
    frames: new Set([at]),
    anchor: at,
    changes: state.changes + 1,
  });
}

/** How choosing a frame treats the frames that are chosen already. */
export type ChooseHow = 'only' | 'toggle' | 'range';

/** The state with the frame at `index`, or the nearest one, chosen as `how` says; the frame on the stage is chosen. */
export function withFrame(state: EditorState, index: number, how: ChooseHow): EditorState {
  const frame = inside(state.show, index);
  const frames = chosenFrames(state, frame, how);
  // A frame that is no longer chosen leaves the stage to the nearest chosen one.
  const shown = frames.has(frame) ? frame : nearest(frames, frame);
  return { ...state, frame: shown, frames, anchor: how === 'range' ? state.anchor : shown };
}

const nearest = (frames: ReadonlySet<number>, to: number) =>
  [...frames].reduce((a, b) => (Math.abs(b - to) < Math.abs(a - to) ? b : a));

function chosenFrames(state: EditorState, frame: number, how: ChooseHow): Set<number> {
  if (how === 'only') return new Set([frame]);
  if (how === 'toggle') {
    const others = [...state.frames].filter((index) => index !== frame);
    const isLeftOut = others.length > 0 && state.frames.has(frame);
    return new Set(isLeftOut ? others : [...others, frame]);
  }

  const [from, to] = [Math.min(state.anchor, frame), Math.max(state.anchor, frame)];
  return new Set(Array.from({ length: to - from + 1 }, (_, i) => from + i));
}
