import type { LightAnswer, LightRequest } from '../api/types.gen';

/** A message to the worker that computes colours; it answers each, in order. */
export type LightAsk =
  | { do: 'load'; request: LightRequest }
  /** Other layers for the loaded show; pixels of the document are ignored. */
  | { do: 'relight'; document: unknown }
  /** The file of a picture that layers project, for what is loaded, relit or made a strip of afterwards. */
  | { do: 'picture'; hash: string; bytes: Uint8Array }
  /** Colours of the loaded show at moments. */
  | { do: 'colours'; moments: Moments }
  /** Colours of another show, which is forgotten afterwards. */
  | { do: 'strip'; request: LightRequest; moments: Moments };

/** Moments at equal distances, seconds from the start of the drive to the first frame. */
export interface Moments {
  from_s: number;
  step_s: number;
  count: number;
}

/** A message from the worker. */
export type LightReply =
  | { of: 'loaded'; answer: LightAnswer }
  /** Moment by moment, robot by robot: red, green and blue. */
  | { of: 'colours'; bytes: Uint8Array }
  /** The request could not be answered; the asking side then gives the worker up. */
  | { of: 'failure' };

/** The classes of the module, as `wasm-bindgen` writes them. */
export interface LightOfModule<Pictures> {
  answer(): string;
  relight(document: string, pictures: Pictures): string;
  colours(from_s: number, step_s: number, count: number): Uint8Array;
  free(): void;
}
export interface PicturesOfModule {
  add(hash: string, file: Uint8Array): string;
}
export interface LightModule<Pictures extends PicturesOfModule> {
  PlannedLight: new (request: string, pictures: Pictures) => LightOfModule<Pictures>;
  LightPictures: new () => Pictures;
}

/** Answers messages with the module. Keeps the show that was loaded last, and all pictures. */
export function createResponder<Pictures extends PicturesOfModule>({
  PlannedLight,
  LightPictures,
}: LightModule<Pictures>): (ask: LightAsk) => LightReply {
  const pictures = new LightPictures();
  let loaded: LightOfModule<Pictures> | null = null;
  const read = (text: string) => JSON.parse(text) as LightAnswer;
  const colours = (
    light: LightOfModule<Pictures>,
    { from_s, step_s, count }: Moments,
  ): LightReply => ({
    of: 'colours',
    bytes: light.colours(from_s, step_s, count),
  });
  return (ask) => {
    switch (ask.do) {
      case 'load':
        loaded?.free();
        loaded = new PlannedLight(JSON.stringify(ask.request), pictures);
        return { of: 'loaded', answer: read(loaded.answer()) };
      case 'relight':
        if (!loaded) return { of: 'failure' };
        return {
          of: 'loaded',
          answer: read(loaded.relight(JSON.stringify(ask.document), pictures)),
        };
      case 'picture':
        return { of: 'loaded', answer: read(pictures.add(ask.hash, ask.bytes)) };
      case 'colours':
        return loaded ? colours(loaded, ask.moments) : { of: 'failure' };
      case 'strip': {
        const light = new PlannedLight(JSON.stringify(ask.request), pictures);
        try {
          return colours(light, ask.moments);
        } finally {
          light.free();
        }
      }
    }
  };
}
