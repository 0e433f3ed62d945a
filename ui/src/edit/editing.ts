import { putShow, Refused } from '../api/http';
import type { Rgb } from '../base/colour';
import { createStore, type Store } from '../base/store';
import { createFullPlan, type FullPlan } from '../live/paths';
import { createEditor, type Editor } from '../model/editor';
import { writeShow } from '../model/json';
import { createSaver, type Saved, type Saver } from '../model/saver';
import type { Show } from '../model/show';
import type { Session } from '../shell/session';
import { createView, type View } from '../stage/view';

export type ToolName = 'arrow' | 'lasso' | 'eyedropper';

/** What the stage shows and snaps to; this screen's own. */
export interface Looks {
  snap: boolean;
  ids: boolean;
  ghosts: boolean;
  ways: boolean;
}

/** A show being edited on this screen. It lives as long as the page, so that undo survives a look at the live view. */
export interface Editing {
  name: string;
  editor: Editor;
  saver: Saver;
  full: FullPlan;
  view: Store<View>;
  tool: Store<ToolName>;
  looks: Store<Looks>;
  /** The last colours that were given, newest first. */
  recent: Store<readonly Rgb[]>;
  /** Colour of the picker. */
  color: Store<Rgb>;
  /** The moment that is looked at, seconds from the start; null: the frame itself. */
  moment: Store<number | null>;
  running: Store<boolean>;
}

const RECENT_MAX = 10;

export function createEditing(
  session: Session,
  name: string,
  show: Show,
  etag: string | null,
): Editing {
  const editor = createEditor(show, session.frame.get());
  const put = async (base: string | null): Promise<Saved> => {
    try {
      const body = JSON.stringify(writeShow(editor.state.get().show));
      return { ok: true, etag: (await putShow(name, body, base)).etag };
    } catch (error) {
      const reason = error instanceof Error ? error.message : String(error);
      return { ok: false, conflict: error instanceof Refused && error.status === 412, reason };
    }
  };
  const saver = createSaver(etag, put);
  let changes = 0;
  editor.state.subscribe(() => {
    const now = editor.state.get();
    session.frame.set(now.frame);
    if (now.changes === changes) return;
    changes = now.changes;
    saver.touch();
  });
  const editing: Editing = {
    name,
    editor,
    saver,
    full: createFullPlan(session.live),
    view: createView(),
    tool: createStore<ToolName>('arrow'),
    looks: createStore<Looks>({ snap: true, ids: false, ghosts: true, ways: false }),
    recent: createStore<readonly Rgb[]>([]),
    color: createStore<Rgb>(0xffc878),
    moment: createStore<number | null>(null),
    running: createStore(false),
  };
  followServer(session, editing);
  return editing;
}

/** Takes in what other screens save, unless this one has something unsaved: then saving finds the conflict. */
function followServer(session: Session, { name, editor, saver }: Editing) {
  const known = new Set([saver.etag()]);
  const look = () => {
    const opened = session.live.opened.get();
    if (opened.name !== name || !opened.show || known.has(opened.etag)) return;
    if (saver.state.get().name !== 'saved' || editor.isGesturing()) return;
    known.add(opened.etag);
    editor.adopt(opened.show);
    saver.settle(opened.etag);
  };
  saver.state.subscribe(() => {
    known.add(saver.etag());
    look();
  });
  session.live.opened.subscribe(look);
}

/** Remembers a colour that was given. */
export const keepColour = (editing: Editing, color: Rgb) => {
  editing.color.set(color);
  editing.recent.update((now) => [color, ...now.filter((c) => c !== color)].slice(0, RECENT_MAX));
};
