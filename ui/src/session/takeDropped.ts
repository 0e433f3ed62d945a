import { ENDINGS } from '../api/formats';
import { createShowInLibrary } from './createShow';
import type { Dropped } from './droppable';
import { notify } from './notices';
import { lookedAt } from './fitness';
import type { Session } from './session';
import { uploadShow } from './upload';
import { goTo, viewNow } from './address';

/** Opens a dropped show on every screen. The editor makes a frame from anything else; it begins a show if none is open. */
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
