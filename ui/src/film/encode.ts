import {
  AudioSample,
  AudioSampleSource,
  BufferTarget,
  canEncodeAudio,
  getFirstEncodableVideoCodec,
  Mp4OutputFormat,
  Output,
  VideoSample,
  VideoSampleSource,
  WebMOutputFormat,
} from 'mediabunny';
import type { FilmKind, FilmMusic, FilmSettings } from './protocol';

/** Video codecs by kind of film, in the order in which they are tried. VP8 is left out: it takes ten times as long. */
const CODECS = { mp4: ['avc', 'av1', 'vp9'], webm: ['vp9', 'av1'] } as const;
/** Bits of video per pixel of each picture: lights on black need few. A larger value makes larger, better files. */
const BITS_A_PIXEL = 0.12;
/** Bits of sound a second. */
const SOUND_BITRATE = 160_000;
/** Most samples of each channel that are encoded at once. */
const SOUND_PIECE = 1 << 16;

export interface FilmEncoder {
  /** Adds picture `number`, counted from 0, four bytes a pixel. Resolves when the encoder takes more. */
  add(picture: Uint8Array, number: number): Promise<void>;
  finish(): Promise<ArrayBuffer>;
}

/**
 * An encoder of this browser for a film of `film_s` seconds. `music` begins at `musicBegins_s`, and ends with the film
 * at the latest. Throws a text for people if the browser cannot encode it.
 */
export async function createEncoder(
  { kind, width, height, fps }: FilmSettings,
  music: FilmMusic | null,
  musicBegins_s: number,
  film_s: number,
): Promise<FilmEncoder> {
  const bitrate = Math.round(width * height * fps * BITS_A_PIXEL);
  const codec = await getFirstEncodableVideoCodec([...CODECS[kind]], { width, height, bitrate });
  if (!codec) throw new Error(cannot(kind));
  const target = new BufferTarget();
  const format = kind === 'mp4' ? new Mp4OutputFormat() : new WebMOutputFormat();
  const output = new Output({ format, target });
  const video = new VideoSampleSource({ codec, bitrate, latencyMode: 'quality' });
  output.addVideoTrack(video, { frameRate: fps });
  const sound = music && (await soundSource(music));
  if (sound) output.addAudioTrack(sound);
  await output.start();
  if (music && sound) await addSound(sound, music, musicBegins_s, film_s);
  return {
    async add(picture, number) {
      const sample = new VideoSample(picture, {
        format: 'RGBX',
        codedWidth: width,
        codedHeight: height,
        timestamp: number / fps,
        duration: 1 / fps,
      });
      await video.add(sample);
      sample.close();
    },
    async finish() {
      await output.finalize();
      if (!target.buffer) throw new Error('The film is empty.');
      return target.buffer;
    },
  };
}

const cannot = (kind: FilmKind) =>
  `This browser cannot make ${kind === 'mp4' ? 'MP4' : 'WebM'} films. Choose the other kind, or another browser.`;

async function soundSource({ channels, rate_Hz }: FilmMusic): Promise<AudioSampleSource> {
  const wanted = { numberOfChannels: channels.length, sampleRate: rate_Hz, bitrate: SOUND_BITRATE };
  if (!(await canEncodeAudio('opus', wanted)))
    throw new Error('This browser cannot encode the music. Make the film without music.');
  return new AudioSampleSource({ codec: 'opus', bitrate: SOUND_BITRATE });
}

/** Adds silence until the music begins, then the music until it or the film ends. */
async function addSound(
  source: AudioSampleSource,
  { channels, rate_Hz }: FilmMusic,
  begins_s: number,
  film_s: number,
) {
  const silent = Math.round(begins_s * rate_Hz);
  const length = channels[0]?.length ?? 0;
  const end = Math.min(silent + length, Math.round(film_s * rate_Hz));
  for (let at = 0; at < end; at += SOUND_PIECE) {
    const count = Math.min(SOUND_PIECE, end - at);
    const data = new Float32Array(count * channels.length);
    channels.forEach((channel, nth) => {
      const from = at - silent;
      const piece = channel.subarray(Math.max(0, from), Math.max(0, from + count));
      data.set(piece, nth * count + Math.max(0, -from));
    });
    const sample = new AudioSample({
      data,
      format: 'f32-planar',
      numberOfChannels: channels.length,
      sampleRate: rate_Hz,
      timestamp: at / rate_Hz,
    });
    await source.add(sample);
    sample.close();
  }
}
