import { listShows, putShow } from '../api/http';
import { writeShow } from '../model/json';
import { newShow } from '../model/show';
import { notify } from './notices';
import type { Session } from './session';
import { freeName } from './upload';

/** Number of robots of a new show when no robot reports. */
const ROBOTS_DEFAULT = 30;

/** Creates a show with a pixel for every robot that reports, and opens it on every screen. */
export async function createShowInLibrary(session: Session): Promise<boolean> {
  try {
    const name = freeName(
      'Untitled',
      (await listShows()).map((entry) => entry.name),
    );
    const here = session.live.fleet.get().rows.length;
    const show = newShow(name, here || ROBOTS_DEFAULT);
    await putShow(name, JSON.stringify(writeShow(show)), 'new');
    return (await session.ask({ do: 'open', name })).ok;
  } catch (error) {
    notify('error', error instanceof Error ? error.message : String(error));
    return false;
  }
}
