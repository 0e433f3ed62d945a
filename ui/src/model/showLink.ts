import { FILE_BYTES_MAX } from '../api/types.gen';
import { readShow } from './json';
import { list, object } from './jsonFields';
import type { Show } from './show';

/** Most characters of a link, or of the packed show in it: chat programs and proxies cut longer ones. */
export const LINK_CHARS_MAX = 32_000;

/** What a link holds: the document as it was packed, and the show that the screen reads in it. */
export interface LinkedShow {
  document: unknown;
  show: Show;
}

/** What people read if a link is no packed text. */
const DAMAGED = 'The link is damaged or was cut off. Ask for it again, or for the show as a file.';
const TOO_LARGE = 'The link holds more than a show may. Ask for the show as a file.';
const NO_SHOW = 'The link holds no show. Ask for it again, or for the show as a file.';

/** Packs the document of a show into characters that an address may have: base64url of raw deflate of its JSON. */
export async function packShow(document: unknown): Promise<string> {
  const text = new Blob([JSON.stringify(document)]);
  const packed = text.stream().pipeThrough(new CompressionStream('deflate-raw'));
  const bytes = new Uint8Array(await new Response(packed).arrayBuffer());
  let binary = '';
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return btoa(binary).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '');
}

/**
 * The show that a link holds. Rejects with a sentence for people. Links come from anywhere, and a short one may hold
 * much: reading stops after `bytes_max` bytes of JSON.
 */
export async function unpackShow(packed: string, bytes_max = FILE_BYTES_MAX): Promise<LinkedShow> {
  if (packed.length > LINK_CHARS_MAX) throw new Error(TOO_LARGE);
  const text = await inflate(fromBase64Url(packed), bytes_max);
  try {
    const document: unknown = JSON.parse(text);
    const { lightbots, frames } = object(document);
    if (typeof lightbots === 'number' && list(frames).length > 0)
      return { document, show: readShow(document) };
  } catch {
    // No JSON, or nested deeper than this browser reads.
  }
  throw new Error(NO_SHOW);
}

function fromBase64Url(text: string): Uint8Array<ArrayBuffer> {
  if (!/^[A-Za-z0-9_-]+$/.test(text)) throw new Error(DAMAGED);
  try {
    const binary = atob(text.replace(/-/g, '+').replace(/_/g, '/'));
    return Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
  } catch {
    throw new Error(DAMAGED);
  }
}

async function inflate(bytes: Uint8Array<ArrayBuffer>, bytes_max: number): Promise<string> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
  const reader = stream.getReader();
  const decoder = new TextDecoder('utf-8', { fatal: true });
  let [text, read] = ['', 0];
  for (;;) {
    const part = await reader.read().catch(() => {
      throw new Error(DAMAGED);
    });
    if (part.done) break;
    read += part.value.byteLength;
    if (read > bytes_max) {
      void reader.cancel().catch(() => undefined);
      throw new Error(TOO_LARGE);
    }
    text += decode(decoder, part.value);
  }
  return text + decode(decoder);
}

function decode(decoder: TextDecoder, bytes?: Uint8Array<ArrayBuffer>): string {
  try {
    return bytes ? decoder.decode(bytes, { stream: true }) : decoder.decode();
  } catch {
    throw new Error(NO_SHOW);
  }
}
