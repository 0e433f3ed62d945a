/** Music as one channel, for looking at and finding beats. */
export interface DecodedMusic {
  /** Samples of the mean of all channels, -1 to 1. */
  samples: Float32Array<ArrayBuffer>;
  /** Samples a second. */
  rate_Hz: number;
}

/** Samples a second of decoded music, hertz: enough for beats, which sound above 11 kHz does not help to find. */
const RATE_HZ = 22_050;

/** Longest music that is taken, seconds: an hour is 318 MB here, and longer than any show. */
const LONGEST_S = 3600;

/** For music longer than this, seconds, the user is told that it needs much memory. */
export const LONG_S = 1200;

/** Largest file that is taken, bytes: a show with its files is at most 64 MiB. */
export const MUSIC_BYTES_MAX = 40 * 2 ** 20;

/** Longest wait for the browser to say how long music lasts, milliseconds; then it counts as unknown. */
const LENGTH_MAX_MS = 10_000;

/** Decodes music to one channel. Throws an error with a message that says what to do. */
export async function decodeMusic(bytes: Uint8Array<ArrayBuffer>): Promise<DecodedMusic> {
  const lasts_s = await lengthOf(bytes);
  if (lasts_s !== null && lasts_s > LONGEST_S)
    throw new Error(
      `It lasts ${Math.round(lasts_s / 60)} min. Cut it to the show: at most ${LONGEST_S / 60} min.`,
    );
  const context = new OfflineAudioContext({
    numberOfChannels: 1,
    length: 1,
    sampleRate: RATE_HZ,
  });
  // Decoding detaches the bytes that it gets, and these are needed for saving: it gets a copy.
  const buffer = await context.decodeAudioData(bytes.slice().buffer).catch(() => {
    throw new Error(
      'This browser cannot play it: it is damaged, or of an unknown kind. Save it as MP3, OGG, WAV or FLAC.',
    );
  });
  return { samples: oneChannel(buffer), rate_Hz: buffer.sampleRate };
}

/** How long music lasts by its header, seconds, before all of it is decoded; null: the browser does not know. */
function lengthOf(bytes: Uint8Array<ArrayBuffer>): Promise<number | null> {
  const address = URL.createObjectURL(new Blob([bytes]));
  const element = new Audio();
  return new Promise<number | null>((resolve) => {
    const known = () => resolve(Number.isFinite(element.duration) ? element.duration : null);
    element.onloadedmetadata = known;
    element.onerror = () => resolve(null);
    setTimeout(known, LENGTH_MAX_MS);
    element.preload = 'metadata';
    element.src = address;
  }).finally(() => {
    element.removeAttribute('src');
    URL.revokeObjectURL(address);
  });
}

/** The mean of all channels. */
export function oneChannel(
  buffer: Pick<AudioBuffer, 'numberOfChannels' | 'length' | 'getChannelData'>,
): Float32Array<ArrayBuffer> {
  const mono = new Float32Array(buffer.length);
  for (let channel = 0; channel < buffer.numberOfChannels; channel++) {
    const samples = buffer.getChannelData(channel);
    for (let i = 0; i < mono.length; i++)
      mono[i] = (mono[i] ?? 0) + (samples[i] ?? 0) / buffer.numberOfChannels;
  }
  return mono;
}

/** Peaks of a waveform for each second. */
export const PEAKS_PER_S = 100;

/** The loudest sample of each hundredth of a second, as a share of the loudest of all; 0 if all are silent. */
export function peaksOf({ samples, rate_Hz }: DecodedMusic): Float32Array {
  const peaks = new Float32Array(Math.ceil((samples.length / rate_Hz) * PEAKS_PER_S));
  let loudest = 0;
  for (let i = 0; i < samples.length; i++) {
    const at = Math.floor((i / rate_Hz) * PEAKS_PER_S);
    const level = Math.abs(samples[i] ?? 0);
    if (level > (peaks[at] ?? 0)) peaks[at] = level;
    if (level > loudest) loudest = level;
  }
  return loudest > 0 ? peaks.map((peak) => peak / loudest) : peaks;
}
