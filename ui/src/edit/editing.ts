import type { Rgb } from '../base/colour';
import { createStore, type Store } from '../base/store';
import { createFullPlan, type FullPlan } from '../session/fullPlan';
import { createEditor, type Editor } from '../model/editor';
import type { Keeper } from '../model/drafts';
import type { Saver } from '../model/saver';
import { createPreview, type Preview } from '../model/preview';
import type { Show } from '../model/show';
import type { Session } from '../session/session';
import { createView, type View } from '../stage/view';
import { followCopy } from '../session/copies';
import { createSaving, draftOf, restoreDraft, type Saving } from './saving';
import { watchLeaving } from './watchLeaving';

export type ToolName = 'arrow' | 'lasso' | 'eyedropper' | 'area';

/** What the stage shows and snaps to; this screen's own. */
export interface Looks {
  snap: boolean;
  ids: boolean;
  ghosts: boolean;
  ways: boolean;
}

/** A show being edited on this screen. It lives as long as the page, so that undo survives a look at the live view. */
export interface Editing {
  /** Its name in the library. Changes once: when a read-only show was saved as a copy and that copy is open. */
  name: string;
  editor: Editor;
  saver: Saver;
  keeper: Keeper;
  full: FullPlan;
  view: Store<View>;
  tool: Store<ToolName>;
  looks: Store<Looks>;
  /** The last colours that were given, newest first. */
  recent: Store<readonly Rgb[]>;
  /** Colour of the picker. */
  color: Store<Rgb>;
  preview: Preview;
  /** The frame whose name is being typed in the strip; null: none. */
  renaming: Store<number | null>;
  /** Another show takes its place: it still saves what is unsaved, and follows nobody. */
  retire(): void;
}

const RECENT_MAX = 10;

/** `wantedDraft`: which of the drafts that were left it begins with; otherwise the newest, if there is any. */
export function createEditing(
  session: Session,
  name: string,
  show: Show,
  etag: string | null,
  wantedDraft: string | null = null,
): Editing {
  const editor = createEditor(show, session.frame.get());
  const draft = draftOf(session, name, show, wantedDraft);
  const saving = createSaving(session.drafts, name, etag, editor, draft, (from, copy) =>
    followCopy(session, from, copy),
  );
  const { saver, keeper } = saving;
  const color = createStore<Rgb>(0xffc878);
  let { selection } = editor.state.get();
  const unfollow = editor.state.subscribe(() => {
    const now = editor.state.get();
    session.frame.set(now.frame);
    if (now.selection === selection) return;
    selection = now.selection;
    // The picker shows the colour of what is chosen.
    const [first] = editor.chosenPixels();
    if (first) color.set(first.color);
  });
  let stop = () => {};
  const editing: Editing = {
    name,
    editor,
    saver,
    keeper,
    full: createFullPlan(session.live),
    view: createView(),
    tool: createStore<ToolName>('arrow'),
    looks: createStore<Looks>({ snap: true, ids: false, ghosts: true, ways: false }),
    recent: createStore<readonly Rgb[]>([]),
    color,
    preview: createPreview(editor),
    renaming: createStore<number | null>(null),
    retire() {
      saver.flush();
      unfollow();
      stop();
      keeper.leave();
    },
  };
  if (draft) restoreDraft(session, editing, draft);
  const stops = [
    moveToCopy(session, editing, saving),
    followServer(session, editing),
    watchLeaving(editing),
  ];
  stop = () => stops.forEach((each) => each());
  return editing;
}

/** Goes on as the copy of a read-only show once that is open, and opens it again where the link broke meanwhile. */
function moveToCopy(session: Session, editing: Editing, saving: Saving): () => void {
  const { live } = session;
  const stops = [
    live.opened.subscribe(() => {
      if (live.opened.get().name === saving.name()) editing.name = saving.name();
    }),
    live.link.subscribe(() => {
      const isDue = saving.name() !== editing.name && live.opened.get().name === editing.name;
      if (isDue && live.link.get() === 'open')
        void session.ask({ do: 'open', name: saving.name() });
    }),
  ];
  return () => stops.forEach((stop) => stop());
}

/** Takes in what other screens save, unless this one has something unsaved: then saving finds the conflict. */
function followServer(session: Session, editing: Editing): () => void {
  const { editor, saver } = editing;
  const known = new Set([saver.etag(), session.live.opened.get().etag]);
  const look = () => {
    const opened = session.live.opened.get();
    if (opened.name !== editing.name || !opened.show || known.has(opened.etag)) return;
    if (saver.state.get().name !== 'saved' || editor.isGesturing()) return;
    known.add(opened.etag);
    editor.adopt(opened.show);
    saver.settle(opened.etag);
  };
  const stops = [
    saver.state.subscribe(() => {
      known.add(saver.etag());
      look();
    }),
    session.live.opened.subscribe(look),
  ];
  return () => stops.forEach((stop) => stop());
}

/** Remembers a colour that was given. */
export const keepColour = (editing: Editing, color: Rgb) => {
  editing.color.set(color);
  editing.recent.update((now) => [color, ...now.filter((c) => c !== color)].slice(0, RECENT_MAX));
};
