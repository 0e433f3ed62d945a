import type { Point } from '../base/geometry';
import type { Rgb } from '../base/colour';
import { createStore, type Store } from '../base/store';
import * as commands from './commands';
import { noHistory, remember, stepBack, stepForth, type History } from './history';
import type { Guide } from './snap';
import type { Frame, Pixel, Show } from './show';

export interface EditorState {
  show: Show;
  /** The frame on the stage. */
  frame: number;
  /** All frames that are chosen, the one on the stage among them. */
  frames: ReadonlySet<number>;
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
  /** Says distance or angle of the drag. */
  hint: string;
}

export const NO_OVERLAY: Overlay = { guides: [], marquee: [], hint: '' };

/** The editor without a screen: a show, what is chosen in it, and what can be undone. */
export interface Editor {
  state: Store<EditorState>;
  current(): Frame | undefined;
  chosenPixels(): Pixel[];
  /** Changes the show as one mark of the history. Within a gesture it only shows. */
  change(label: string, change: (show: Show, state: EditorState) => Show): void;
  /** Begins a gesture: what follows is one mark, and `cancel` restores what was. */
  begin(): void;
  commit(label: string): void;
  cancel(): void;
  isGesturing(): boolean;
  undo(): string | null;
  redo(): string | null;
  select(ids: Iterable<number>): void;
  goToFrame(index: number, how?: 'only' | 'add' | 'range'): void;
  /** Chooses frames; the first of them is on the stage. */
  chooseFrames(indices: readonly number[]): void;
  overlay(overlay: Overlay): void;
  /** Copies chosen pixels; answers how many. */
  copy(): number;
  paste(): number;
  /** Takes in another state of the same show, as another screen saved it: one mark, and nothing to save. */
  adopt(show: Show): void;
}

export function createEditor(show: Show, frame = 0): Editor {
  const state = createStore<EditorState>({
    show,
    frame: Math.max(0, Math.min(show.frames.length - 1, frame)),
    frames: new Set([frame]),
    selection: new Set(),
    history: noHistory(),
    overlay: NO_OVERLAY,
    changes: 0,
  });
  let gesture: EditorState | null = null;
  let clipboard: readonly Pixel[] = [];

  const settle = (next: EditorState): EditorState => {
    const last = next.show.frames.length - 1;
    const at = Math.max(0, Math.min(last, next.frame));
    const frames = new Set([...next.frames].filter((i) => i <= last).concat(at));
    return { ...next, frame: at, frames };
  };
  const mark = (before: Show, after: Show, label: string, at: number, toSave = 1) =>
    state.update((s) =>
      settle({
        ...s,
        show: after,
        history: remember(s.history, { before, after, label, frame: at }),
        changes: s.changes + toSave,
      }),
    );
  const travel = (
    step: (h: History<Show>) => ReturnType<typeof stepBack<Show>>,
    pick: 'before' | 'after',
  ): string | null => {
    if (gesture) editor.cancel();
    const moved = step(state.get().history);
    if (!moved) return null;
    const [history, done] = moved;
    state.update((s) => {
      const at = Math.min(done.frame, done[pick].frames.length - 1);
      const frames = new Set([at]);
      return settle({ ...s, show: done[pick], history, frame: at, frames, changes: s.changes + 1 });
    });
    return done.label;
  };

  const editor: Editor = {
    state,
    current: () => state.get().show.frames[state.get().frame],
    chosenPixels: () =>
      editor.current()?.pixels.filter((p) => state.get().selection.has(p.id)) ?? [],
    change(label, change) {
      const now = state.get();
      const next = change(now.show, now);
      if (next === now.show) return;
      if (gesture) state.update((s) => settle({ ...s, show: next }));
      else mark(now.show, next, label, now.frame);
    },
    begin() {
      if (!gesture) gesture = state.get();
    },
    commit(label) {
      const from = gesture;
      gesture = null;
      editor.overlay(NO_OVERLAY);
      const { show: after, frame: at } = state.get();
      if (from && from.show !== after) mark(from.show, after, label, at);
    },
    cancel() {
      const from = gesture;
      gesture = null;
      if (from) state.set({ ...from, overlay: NO_OVERLAY });
    },
    isGesturing: () => gesture !== null,
    undo: () => travel(stepBack, 'before'),
    redo: () => travel(stepForth, 'after'),
    select(ids) {
      const selection = new Set(ids);
      state.update((s) => ({ ...s, selection }));
    },
    goToFrame(index, how = 'only') {
      state.update((s) => {
        const at = Math.max(0, Math.min(s.show.frames.length - 1, index));
        return { ...s, frame: at, frames: chosenFrames(s, at, how) };
      });
    },
    chooseFrames(indices) {
      const [at] = indices;
      if (at !== undefined)
        state.update((s) => settle({ ...s, frame: at, frames: new Set(indices) }));
    },
    overlay: (overlay) => state.update((s) => ({ ...s, overlay })),
    copy() {
      clipboard = editor.chosenPixels();
      return clipboard.length;
    },
    paste() {
      const ids = new Map(clipboard.map((p) => [p.id, p]));
      const mine = (editor.current()?.pixels ?? []).filter((p) => ids.has(p.id));
      editor.change('Paste', (now, s) => {
        const places = new Map<number, Point>(clipboard.map((p) => [p.id, p]));
        const colors = new Map<number, Rgb>(clipboard.map((p) => [p.id, p.color]));
        return commands.recolour(commands.placePixels(now, s.frame, places), s.frame, colors);
      });
      editor.select(mine.map((p) => p.id));
      return mine.length;
    },
    adopt(next) {
      gesture = null;
      const { show: before, frame: at } = state.get();
      editor.overlay(NO_OVERLAY);
      mark(before, keepKeys(before, next), 'Changes of another screen', at, 0);
    },
  };
  return editor;
}

function chosenFrames(s: EditorState, at: number, how: 'only' | 'add' | 'range'): Set<number> {
  if (how === 'only') return new Set([at]);
  if (how === 'add') return new Set([...s.frames, at]);
  const [from, to] = [Math.min(s.frame, at), Math.max(s.frame, at)];
  return new Set(Array.from({ length: to - from + 1 }, (_, i) => from + i));
}

/** The same frame keeps its key, so that the strip does not flicker when another screen saves. */
function keepKeys(before: Show, after: Show): Show {
  const frames = after.frames.map((f, i) => ({ ...f, key: before.frames[i]?.key ?? f.key }));
  return { ...after, frames };
}
