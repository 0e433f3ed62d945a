import { OWN_FORMAT, type Format } from '../api/formats';
import { convertShow, getFile, getShow } from '../api/http';
import { FORMATS, type ShowEntry } from '../api/types.gen';

/** Gives the browser a file to save. */
export function download(file: Blob, name: string) {
  const address = URL.createObjectURL(file);
  const link = document.createElement('a');
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Saves a show as a file of a format. `show` is the document as our own format holds it. */
export async function downloadShow(show: unknown, name: string, format: Format) {
  const text = JSON.stringify(show, null, 1);
  const file =
    format.name === OWN_FORMAT.name
      ? new Blob([text], { type: format.mediaType })
      : await convertShow(text, format.name);
  download(file, `${name}${format.endings[0]}`);
}

/**
 * Saves a show of the library as a file of a format. In our own format, the file of a read-only show is given
 * unchanged, because it may hold more than the document.
 */
export async function downloadFromLibrary({ name, read_only }: ShowEntry, format: Format) {
  if (read_only !== null && format.name === OWN_FORMAT.name) {
    const file = await getFile(name);
    const kept = FORMATS.find((known) => known.mediaType === file.type) ?? OWN_FORMAT;
    download(file, `${name}${kept.endings[0]}`);
    return;
  }
  await downloadShow((await getShow(name)).document, name, format);
}
