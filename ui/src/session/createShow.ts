import { listShows, putShow } from '../api/http';
import { writeShow } from '../model/json';
import { newShow } from '../model/show';
import { tell } from './notices';
import type { Session } from './session';
import { freeName } from './upload';

/** Robots of a new show when none are here to be counted. */
const ROBOTS_DEFAULT = 30;

/** Begins a show with a pixel for every robot that is here, and opens it on every screen. */
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
    tell('error', error instanceof Error ? error.message : String(error));
    return false;
  }
}
