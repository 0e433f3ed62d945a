import type { FilmMusic } from './protocol';

/** Samples a second that Opus takes, hertz. */
const RATE_HZ = 48_000;
/** Most channels that are used of the music. */
const CHANNELS = 2;

/** Decodes music for the sound of a film. */
export async function decodeForFilm(bytes: Uint8Array<ArrayBuffer>): Promise<FilmMusic> {
  const context = new OfflineAudioContext(CHANNELS, 1, RATE_HZ);
  // Decoding detaches the bytes that it gets, and these are needed again: it gets a copy.
  const buffer = await context.decodeAudioData(bytes.slice().buffer);
  const count = Math.min(buffer.numberOfChannels, CHANNELS);
  const channels = Array.from({ length: count }, (_, nth) => buffer.getChannelData(nth));
  return { rate_Hz: buffer.sampleRate, channels };
}
