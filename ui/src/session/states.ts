import { getShow, getState, putShow } from '../api/http';
import { readShow } from '../model/json';
import { notify } from './notices';
import type { Session } from './session';

/** When a state was saved, for people. */
export const savedText = (saved_ms: number) => new Date(saved_ms).toLocaleString();

/**
 * Restores a saved state, in this screen's editor if it edits the show, else in the library. This is a further save:
 * what it replaces becomes an earlier state.
 */
export async function restoreState(session: Session, name: string, number: number, when: string) {
  const document = await getState(name, number);
  const editing = session.editing.get();
  if (editing?.name === name) {
    editing.editor.change('Restored a save', () => readShow(document));
    editing.saver.flush();
  } else {
    const { etag } = await getShow(name);
    await putShow(name, JSON.stringify(document), etag);
  }
  notify('good', `${name} is as it was saved on ${when}. What it was before is an earlier save.`);
}
