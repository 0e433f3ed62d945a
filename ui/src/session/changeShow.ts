import { messageOf } from '../base/errors';
import { getShow, putShow } from '../api/http';
import { readShow, writeShow } from '../model/json';
import type { Show } from '../model/show';
import { followCopy } from './copies';
import { lookedAt } from './fitness';
import { notify } from './notices';
import type { Session } from './session';

/**
 * Changes the show that the user looks at: in this screen's editor if it edits the show, else in the library. Without a
 * show, nothing happens. A failed save is shown as a notice.
 */
export async function changeShow(session: Session, label: string, change: (show: Show) => Show) {
  const { name } = lookedAt(session);
  const editing = session.editing.get();
  if (name === null) return;
  if (editing?.name === name) {
    editing.editor.change(label, change);
    return;
  }
  try {
    const { document, etag } = await getShow(name);
    const show = readShow(document);
    const next = change(show);
    if (next === show) return;
    const entry = await putShow(name, JSON.stringify(writeShow(next)), etag);
    if (entry.name !== name) followCopy(session, name, entry);
  } catch (error) {
    notify('error', messageOf(error));
  }
}
