import { messageOf } from '../base/errors';
import { deleteShow, getFile, getShow, listShows, putShow } from '../api/http';
import { editShow, showInAddress } from './address';
import { notify, notifyWithUndo } from './notices';
import { openShow } from './openShow';
import type { Session } from './session';
import { freeName } from './upload';

/** Runs a request and answers whether it succeeded. A notice shows the message of a failure. */
export const attempt = (act: () => Promise<unknown>) =>
  act().then(
    () => true,
    (error: unknown) => {
      notify('error', messageOf(error));
      return false;
    },
  );

/** Saves a copy of a show's document under `wanted`, with a number if that name is taken; answers the copy's name. */
export async function copyShow(from: string, wanted: string): Promise<string> {
  const { document } = await getShow(from);
  const taken = (await listShows()).map((entry) => entry.name);
  const name = freeName(wanted, taken);
  await putShow(name, JSON.stringify(document), 'new');
  return name;
}

/** Renames a show with everything in its file and its saved states; an open show stays open. */
export async function renameShow(session: Session, from: string, to: string) {
  const { etag } = await getShow(from);
  await putShow(to, await getFile(from), 'new');
  if (session.live.opened.get().name === from) await openShow(session, to);
  else if (showInAddress() === from) editShow(to);
  await deleteShow(from, etag, to);
}

/** Deletes a show, and offers for a few seconds to put its file back. `changed` is called after each. */
export async function deleteWithUndo(name: string, changed: () => void) {
  const { etag } = await getShow(name);
  const file = await getFile(name);
  await deleteShow(name, etag);
  changed();
  notifyWithUndo(`${name} is deleted.`, () =>
    attempt(() => putShow(name, file, 'new')).then(changed),
  );
}
