import { stem } from '../api/formats';
import { listShows, putShow, Refused } from '../api/http';
import { FILE_BYTES_MAX } from '../api/types.gen';
import { notify } from './notices';
import { openShow } from './openShow';
import type { Session } from './session';

/** A name for the library from a file's name. */
export const nameFromFile = (file: string) =>
  stem(file)
    .replace(/[^\p{L}\p{N} _.-]+/gu, ' ')
    .trim()
    .slice(0, 60) || 'Show';

/** The first free name of `base`, `base 2`, `base 3`… */
export function freeName(base: string, taken: readonly string[]): string {
  const all = new Set(taken.map((name) => name.toLowerCase()));
  if (!all.has(base.toLowerCase())) return base;
  for (let n = 2; ; n++) if (!all.has(`${base} ${n}`.toLowerCase())) return `${base} ${n}`;
}

/** Puts a file into the library under a free name and opens it on every screen. */
export async function uploadShow(session: Session, file: File) {
  if (file.size > FILE_BYTES_MAX) {
    notify('error', `Can't import ${file.name}: it is larger than ${FILE_BYTES_MAX / 2 ** 20} MB.`);
    return;
  }
  try {
    const taken = (await listShows()).map((entry) => entry.name);
    const name = freeName(nameFromFile(file.name), taken);
    const entry = await putShow(name, await file.arrayBuffer(), 'new');
    if (await openShow(session, entry.name)) notify('good', `Imported and opened "${entry.name}".`);
  } catch (error) {
    const reason = error instanceof Refused ? error.message : String(error);
    notify('error', `Can't import ${file.name}: ${reason}`);
  }
}
