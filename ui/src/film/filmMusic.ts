import type { FilmMusic } from './protocol';

/** What Opus takes. */
const RATE_HZ = 48_000;
const CHANNELS = 2;

/** Decodes music for the sound of a film. */
export async function decodeForFilm(bytes: Uint8Array<ArrayBuffer>): Promise<FilmMusic> {
  const context = new OfflineAudioContext(CHANNELS, 1, RATE_HZ);
  // Decoding takes the bytes away, and they are needed again.
  const buffer = await context.decodeAudioData(bytes.slice().buffer);
  const count = Math.min(buffer.numberOfChannels, CHANNELS);
  const channels = Array.from({ length: count }, (_, nth) => buffer.getChannelData(nth));
  return { rate_Hz: buffer.sampleRate, channels };
}
