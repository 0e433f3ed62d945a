import { convertShow, getShow } from '../api/http';

/** Gives the browser a file to save. */
export function download(text: string, file: string) {
  const address = URL.createObjectURL(new Blob([text], { type: 'application/json' }));
  const link = document.createElement('a');
  link.href = address;
  link.download = file;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Saves a show of the library as a file, ours or the original's. */
export async function downloadShow(name: string, format: 'lightbots' | 'original') {
  const { document } = await getShow(name);
  if (format === 'lightbots') download(JSON.stringify(document, null, 1), `${name}.lightbots.json`);
  else download(await convertShow(JSON.stringify(document), 'original'), `${name}.json`);
}
