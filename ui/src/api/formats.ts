import { FORMATS } from './types.gen';

/** A row of the server's table of file formats. */
export type Format = (typeof FORMATS)[number];

/** Our own format, which the screen writes without the server. */
export const OWN_FORMAT: Format = FORMATS[0];

/** The endings of every format, in lower case. */
export const ENDINGS: readonly string[] = FORMATS.flatMap((format) => [...format.endings]);

/** What a file dialog offers: the last part of each ending (`.zip` of `.csv.zip`), because dialogs know only that, and
 * media types. */
export const ACCEPTED = [
  ...new Set([
    ...ENDINGS.map((ending) => ending.slice(ending.lastIndexOf('.'))),
    ...FORMATS.map((format) => format.mediaType),
  ]),
].join(',');

/** The first ending of each format, joined by "or". */
export const ENDINGS_IN_WORDS = FORMATS.map((format) => format.endings[0]).join(' or ');

/** A file's name without the longest ending of a format that it has. */
export function stem(file: string): string {
  const lower = file.toLowerCase();
  const fitting = ENDINGS.filter((ending) => lower.endsWith(ending)).map((ending) => ending.length);
  return file.slice(0, file.length - Math.max(0, ...fitting));
}

/** The words of a menu that saves a show in a format. */
export const exportLabel = (format: Format) =>
  format.name === OWN_FORMAT.name
    ? 'Download'
    : `Export for ${format.program} (${format.endings[0]})`;
