import { stem } from '../api/formats';
import { listShows, putShow, Refused } from '../api/http';
import { FILE_BYTES_MAX, type ShowEntry } from '../api/types.gen';
import { sentence } from '../base/words';
import { notify } from './notices';
import { openShow } from './openShow';
import type { Session } from './session';

/** A name for the library from a file's name: other characters become spaces; at most 60 characters, never empty. */
export const nameFromFile = (file: string) =>
  stem(file)
    .replace(/[^\p{L}\p{N} _.-]+/gu, ' ')
    .trim()
    .slice(0, 60) || 'Show';

/** The first free name of `base`, `base 2`, `base 3`… Upper and lower case count as equal. */
export function freeName(base: string, taken: readonly string[]): string {
  const all = new Set(taken.map((name) => name.toLowerCase()));
  if (!all.has(base.toLowerCase())) return base;
  for (let n = 2; ; n++) if (!all.has(`${base} ${n}`.toLowerCase())) return `${base} ${n}`;
}

/** Most findings of an import that its notice lists. */
const FINDINGS_MAX = 4;

/** Tone and lines of the notice after an import. Findings are listed up to `FINDINGS_MAX`; mere notes are left out. */
export function importedLines({
  name,
  issues,
}: Pick<ShowEntry, 'name' | 'issues'>): ['good' | 'warning', string[]] {
  const findings = issues
    .filter((one) => one.severity !== 'note')
    .map((one) => sentence(one.message));
  const more = findings.length - FINDINGS_MAX;
  const lines = [
    `Imported and opened "${name}".`,
    ...findings.slice(0, FINDINGS_MAX),
    ...(more > 0 ? [`${more} more.`] : []),
  ];
  return [findings.length > 0 ? 'warning' : 'good', lines];
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
    if (!(await openShow(session, entry.name))) return;
    const [tone, lines] = importedLines(entry);
    notify(tone, lines.join('\n'));
  } catch (error) {
    const reason = error instanceof Refused ? error.message : String(error);
    notify('error', `Can't import ${file.name}: ${reason}`);
  }
}
