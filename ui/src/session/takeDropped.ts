import { ENDINGS } from '../api/formats';
import { createShowInLibrary } from './createShow';
import type { Dropped } from './droppable';
import { notify } from './notices';
import { lookedAt } from './fitness';
import type { Session } from './session';
import { uploadShow } from './upload';
import { goTo, viewNow } from './address';

/**
 * Opens a single dropped show file on every screen. Anything else is left to the editor, in a new show if the view is
 * `new` or no show is open. A read-only show takes nothing else; a notice says so.
 */
export async function takeDropped(session: Session, dropped: Omit<Dropped, 'into'>) {
  const [file] = dropped.files;
  if (file && dropped.files.length === 1 && isShow(file.name)) return uploadShow(session, file);
  const { name, readOnly } = lookedAt(session);
  if (readOnly !== null && viewNow() !== 'new') {
    notify(
      'error',
      `${name} is read-only. Save it under another name first, or open another show.`,
    );
    return;
  }
  const isNew = name === null || viewNow() === 'new';
  const into = isNew ? await createShowInLibrary(session) : null;
  if (isNew && into === null) return;
  session.dropped.set({ ...dropped, into });
  if (viewNow() !== 'edit') goTo('edit');
}

const isShow = (name: string) => ENDINGS.some((ending) => name.toLowerCase().endsWith(ending));
