import { messageOf } from '../base/errors';
import { getShow, putShow, Refused } from '../api/http';
import type { ShowEntry } from '../api/types.gen';
import {
  createKeeper,
  type Draft,
  type Drafts,
  type Keeper,
  type LeftDraft,
} from '../model/drafts';
import type { Editor } from '../model/editor';
import { readShow, writeShow } from '../model/json';
import { createSaver, type Saved, type Saver } from '../model/saver';
import type { Show } from '../model/show';
import { notify } from '../session/notices';
import type { Session } from '../session/session';

/** Saves the changes of a show to this browser's storage and to the server. */
export interface Saving {
  saver: Saver;
  keeper: Keeper;
  /** Name of the show that the next save goes to: the edited one, or its copy once a save became a copy. */
  name(): string;
}

const textOf = (show: Show) => JSON.stringify(writeShow(show));
/** A text that is the same for documents of the same show, whatever the order of the keys that this screen reads. */
const normal = (document: unknown) => textOf(readShow(document));

/**
 * `first`: name of the show; `etag`: its version. `left`: a draft that an earlier page left and this editor begins
 * with; null: none. `copied`: called when a save became a copy, which later saves go to.
 */
export function createSaving(
  drafts: Drafts,
  first: string,
  etag: string | null,
  editor: Editor,
  left: LeftDraft | null,
  copied: (from: string, copy: ShowEntry) => void,
): Saving {
  let name = first;
  const target: Target = {
    name: () => name,
    move(copy) {
      const from = name;
      name = copy.name;
      keeper.rename(name);
      copied(from, copy);
    },
  };
  const saver = createSaver(left ? left.etag : etag, createPut(target, editor));
  const draft = (): Draft => ({
    etag: saver.etag(),
    document: writeShow(editor.state.get().show),
  });
  const keeper = createKeeper(drafts, name, draft, left?.id);
  let { changes } = editor.state.get();
  editor.state.subscribe(() => {
    const now = editor.state.get().changes;
    if (now === changes) return;
    changes = now;
    saver.touch();
    keeper.touch();
  });
  saver.state.subscribe(() => {
    if (saver.state.get().name === 'saved') keeper.saved();
  });
  return { saver, keeper, name: target.name };
}

/** The show in the library that is saved to. */
interface Target {
  name(): string;
  /** The server saved what was sent as this copy: later saves go to it. */
  move(copy: ShowEntry): void;
}

function createPut(target: Target, editor: Editor) {
  /** The show of the last request that failed without a conflict: the server may have saved it. Null: none. */
  let sent: string | null = null;
  const mine = async () => {
    const theirs = await getShow(target.name());
    return sent !== null && normal(theirs.document) === sent ? theirs.etag : null;
  };
  const save = async (body: string, base: string): Promise<Saved> => {
    const entry = await putShow(target.name(), body, base);
    if (entry.name !== target.name()) target.move(entry);
    return { ok: true, etag: entry.etag };
  };
  return async (base: string | null): Promise<Saved> => {
    const body = textOf(editor.state.get().show);
    try {
      // A show without a version in the library must not replace one.
      const saved = await save(body, base ?? 'new');
      sent = null;
      return saved;
    } catch (error) {
      const reason = messageOf(error);
      const conflict = error instanceof Refused && error.status === 412;
      if (!conflict) sent = normal(writeShow(editor.state.get().show));
      const etag = conflict ? await mine().catch(() => null) : null;
      if (etag === null) return { ok: false, conflict, reason };
      // The server has the show of the failed request: save the changes since then on top of it.
      return save(body, etag).catch((again: unknown) => ({
        ok: false,
        conflict: again instanceof Refused && again.status === 412,
        reason,
      }));
    }
  };
}

/**
 * The left draft of this show with the id `wanted`, else the newest; null: there is none. Drafts that equal `show` hold
 * no unsaved changes and are dropped.
 */
export function draftOf(
  session: Session,
  name: string,
  show: Show,
  wanted: string | null,
): LeftDraft | null {
  const text = textOf(show);
  const left = session.drafts.left().filter((draft) => draft.name === name);
  const isSaved = (draft: LeftDraft) => normal(draft.document) === text;
  for (const draft of left) if (isSaved(draft)) session.drafts.drop(draft.id);
  const unsaved = left.filter((draft) => !isSaved(draft));
  return unsaved.find((draft) => draft.id === wanted) ?? unsaved[0] ?? null;
}

/** Restores a draft as a change of the editor, which is then saved, and tells the user. */
export function restoreDraft(session: Session, { editor, keeper }: Restored, draft: LeftDraft) {
  editor.change('Restored changes', () => readShow(draft.document));
  keeper.flush();
  session.orphans.set(session.drafts.left());
  notify('good', `Your last changes of ${draft.name} were kept in this browser and are back.`);
}

interface Restored {
  editor: Editor;
  keeper: Keeper;
}
