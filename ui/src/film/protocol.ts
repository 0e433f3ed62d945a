import type { LightRequest } from '../api/types.gen';
import type { PictureFile } from '../light/pictures';

/** What a film is written as. */
export type FilmKind = 'mp4' | 'webm';

export interface FilmSettings {
  kind: FilmKind;
  width: number;
  height: number;
  fps: number;
  /** Whether the film shows the floor from seats before its front edge; otherwise from above. */
  fromFront: boolean;
}

/** Decoded music. */
export interface FilmMusic {
  rate_Hz: number;
  /** Samples of each channel, -1 to 1. */
  channels: Float32Array<ArrayBuffer>[];
}

/** The one message to a worker: make this film. */
export interface FilmAsk {
  request: LightRequest;
  pictures: PictureFile[];
  settings: FilmSettings;
  music: FilmMusic | null;
}

/** Messages from the worker. */
export type FilmReply =
  | { of: 'painted'; picture: number; pictures: number }
  | { of: 'film'; bytes: ArrayBuffer }
  | { of: 'failure'; message: string };
