import type { Rgb } from '../base/colour';
import type { Point } from '../base/geometry';
import { createStore, type Store } from '../base/store';
import * as commands from './commands';
import {
  firstState,
  NO_OVERLAY,
  withFrame,
  withinShow,
  withMark,
  withShowOf,
  type ChooseHow,
  type EditorState,
  type Overlay,
} from './editorState';
import { stepBack, stepForth, stepTo } from './history';
import type { Frame, Pixel, Show } from './show';

/** The editor without a screen: a show, the selection, and the history. */
export interface Editor extends Gestures, Choice, CopyPaste {
  state: Store<EditorState>;
  current(): Frame | undefined;
  chosenPixels(): Pixel[];
  /** Cancels a gesture, then takes back the last mark; answers its label, null: there is none. */
  undo(): string | null;
  redo(): string | null;
  /** Goes to the state after the first `changes` marks of the history; 0: the oldest state. */
  travelTo(changes: number): void;
}

/** Changes of the show. */
interface Gestures {
  /** Changes the show as one mark of the history; no mark if the show stays the same, or within a gesture. */
  change(label: string, change: (show: Show, state: EditorState) => Show): void;
  /** Begins a gesture, unless one is under way: all changes until `commit` are one mark; `cancel` takes them back. */
  begin(): void;
  commit(label: string): void;
  cancel(): void;
  isGesturing(): boolean;
  overlay(overlay: Overlay): void;
  /** Takes over the show as another screen saved it: one mark, nothing to save. A gesture ends without its own mark. */
  adopt(show: Show): void;
}

interface Choice {
  select(ids: Iterable<number>): void;
  goToFrame(index: number, how?: ChooseHow): void;
  /** Chooses frames by index; the first in the list is put on the stage. An empty list changes nothing. */
  chooseFrames(indices: readonly number[]): void;
}

interface CopyPaste {
  /** Copies the chosen pixels; answers their number. */
  copy(): number;
  /** Gives the copied places and colours to pixels with the same ids in the frame on the stage; answers how many. */
  paste(): number;
  canPaste(): boolean;
}

export function createEditor(show: Show, frame = 0): Editor {
  const state = createStore(firstState(show, frame));
  const current = () => state.get().show.frames[state.get().frame];
  const chosenPixels = () =>
    current()?.pixels.filter((pixel) => state.get().selection.has(pixel.id)) ?? [];
  const gestures = createGestures(state);
  const choice = createChoice(state);
  const travel = (step: typeof stepBack, side: 'before' | 'after'): string | null => {
    gestures.cancel();
    const moved = step(state.get().history);
    if (!moved) return null;
    const [history, mark] = moved;
    state.update((now) => withShowOf(now, history, mark[side], mark.frame));
    return mark.label;
  };
  return {
    state,
    current,
    chosenPixels,
    ...gestures,
    ...choice,
    ...createCopyPaste({ ...gestures, ...choice, current, chosenPixels }),
    undo: () => travel(stepBack, 'before'),
    redo: () => travel(stepForth, 'after'),
    travelTo(changes) {
      gestures.cancel();
      const moved = stepTo(state.get().history, changes);
      if (!moved) return;
      const [history, mark, side] = moved;
      state.update((now) => withShowOf(now, history, mark[side], mark.frame));
    },
  };
}

function createGestures(state: Store<EditorState>): Gestures {
  /** The state that a gesture began with; null: there is no gesture. */
  let begun: EditorState | null = null;
  const overlay = (next: Overlay) => state.update((now) => ({ ...now, overlay: next }));
  const end = () => {
    const from = begun;
    begun = null;
    return from;
  };
  return {
    overlay,
    isGesturing: () => begun !== null,
    change(label, change) {
      const now = state.get();
      const after = change(now.show, now);
      if (after === now.show) return;
      if (begun) state.set(withinShow({ ...now, show: after }));
      else state.set(withMark(now, { before: now.show, after, label, frame: now.frame }));
    },
    begin() {
      begun ??= state.get();
    },
    commit(label) {
      const from = end();
      overlay(NO_OVERLAY);
      const { show: after, frame } = state.get();
      if (from && from.show !== after)
        state.update((now) => withMark(now, { before: from.show, after, label, frame }));
    },
    cancel() {
      const from = end();
      if (from) state.set({ ...from, overlay: NO_OVERLAY });
    },
    adopt(next) {
      end();
      overlay(NO_OVERLAY);
      const { show: before, frame } = state.get();
      const mark = {
        before,
        after: keepKeys(before, next),
        label: 'Changes of another screen',
        frame,
      };
      state.update((now) => withMark(now, mark, 0));
    },
  };
}

const createChoice = (state: Store<EditorState>): Choice => ({
  select(ids) {
    const selection = new Set(ids);
    state.update((now) => ({ ...now, selection }));
  },
  goToFrame: (index, how = 'only') => state.update((now) => withFrame(now, index, how)),
  chooseFrames(indices) {
    const [frame] = indices;
    if (frame !== undefined)
      state.update((now) => withinShow({ ...now, frame, anchor: frame, frames: new Set(indices) }));
  },
});

function createCopyPaste(
  editor: Pick<Editor, 'change' | 'select' | 'current' | 'chosenPixels'>,
): CopyPaste {
  let copied: readonly Pixel[] = [];
  return {
    copy() {
      copied = editor.chosenPixels();
      return copied.length;
    },
    paste() {
      const places = new Map<number, Point>(copied.map((pixel) => [pixel.id, pixel]));
      const colors = new Map<number, Rgb>(copied.map((pixel) => [pixel.id, pixel.color]));
      const pasted = (editor.current()?.pixels ?? []).filter((pixel) => places.has(pixel.id));
      editor.change('Paste', (show, { frame }) =>
        commands.recolour(commands.placePixels(show, frame, places), frame, colors),
      );
      editor.select(pasted.map((pixel) => pixel.id));
      return pasted.length;
    },
    canPaste: () => copied.length > 0,
  };
}

/** `after` with the keys of `before` at the same indices, so that the strip of frames does not flicker. */
function keepKeys(before: Show, after: Show): Show {
  const frames = after.frames.map((f, i) => ({ ...f, key: before.frames[i]?.key ?? f.key }));
  return { ...after, frames };
}
