import { deleteShow, getShow, listShows, putShow } from '../api/http';
import type { Session } from './session';
import { tell, tellWithUndo } from './notices';
import { freeName } from './upload';

/** Runs what may be refused; the refusal is told in the server's words. */
export const attempt = (act: () => Promise<unknown>) =>
  act().then(
    () => true,
    (error: unknown) => {
      tell('error', error instanceof Error ? error.message : String(error));
      return false;
    },
  );

/** Copies a show under a name nobody has; answers that name. */
export async function copyShow(from: string, wanted: string): Promise<string> {
  const { document } = await getShow(from);
  const taken = (await listShows()).map((entry) => entry.name);
  const name = freeName(wanted, taken);
  await putShow(name, JSON.stringify(document), 'new');
  return name;
}

/** Gives a show another name; where it is open, it stays open. */
export async function renameShow(session: Session, from: string, to: string) {
  const { document, etag } = await getShow(from);
  await putShow(to, JSON.stringify(document), 'new');
  if (session.live.opened.get().name === from) await session.ask({ do: 'open', name: to });
  await deleteShow(from, etag);
}

/** Deletes a show, and offers to bring it back. */
export async function deleteWithUndo(name: string, changed: () => void) {
  const { document, etag } = await getShow(name);
  await deleteShow(name, etag);
  changed();
  tellWithUndo(`${name} is deleted.`, () =>
    attempt(() => putShow(name, JSON.stringify(document), 'new')).then(changed),
  );
}
