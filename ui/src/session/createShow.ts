import { messageOf } from '../base/errors';
import { listShows, putShow } from '../api/http';
import { writeShow } from '../model/json';
import { newShow, type Frame, type Stage } from '../model/show';
import { notify } from './notices';
import { openShow } from './openShow';
import type { Session } from './session';
import { freeName, nameFromFile } from './upload';

/** Number of robots of a new show when the fleet table is empty. */
export const ROBOTS_DEFAULT = 30;

/** What a new show has of its own. */
interface Begun {
  /** Its name; a number is added if the name is taken. */
  title?: string;
  stage?: Stage;
  frames?: readonly Frame[];
}

/**
 * Creates a show in the library and opens it on every screen. Without `frames` it gets a pixel for each row of the
 * fleet table, or `ROBOTS_DEFAULT` if there is no row. Answers its name; null: it could not be created or opened.
 */
export async function createShowInLibrary(
  session: Session,
  begun: Begun = {},
): Promise<string | null> {
  try {
    const name = freeName(
      begun.title === undefined ? 'Untitled' : nameFromFile(begun.title),
      (await listShows()).map((entry) => entry.name),
    );
    const here = session.live.fleet.get().rows.length;
    const show = newShow(name, here || ROBOTS_DEFAULT, begun.stage);
    const document = writeShow(begun.frames ? { ...show, frames: begun.frames } : show);
    await putShow(name, JSON.stringify(document), 'new');
    return (await openShow(session, name)) ? name : null;
  } catch (error) {
    notify('error', messageOf(error));
    return null;
  }
}
