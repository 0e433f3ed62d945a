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
  /** The show in the library that the next save goes to: once a read-only show was saved, its copy. */
  name(): string;
}

const textOf = (show: Show) => JSON.stringify(writeShow(show));
/** The same text for the same show, whatever the order of keys in the document. */
const normal = (document: unknown) => textOf(readShow(document));

/**
 * `left`: what an earlier page left and this editor begins with. `copied`: the show is read-only, and a copy of it was
 * saved and is what is saved from now on.
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

/** The show that is saved. */
interface Target {
  name(): string;
  /** What was sent is in the library as this copy. */
  move(copy: ShowEntry): void;
}

function createPut(target: Target, editor: Editor) {
  /** The body of a request without an answer: the server may have saved it. */
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
      // The request without an answer was saved: save the changes since then on top of it.
      return save(body, etag).catch((again: unknown) => ({
        ok: false,
        conflict: again instanceof Refused && again.status === 412,
        reason,
      }));
    }
  };
}

/** The draft of a closed page with unsaved changes of this show: the `wanted` one, or the newest; `null`: none. */
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

/** Restores a draft as a change. If another screen saved a newer version, saving finds the conflict. */
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
