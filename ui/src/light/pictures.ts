import { messageOf } from '../base/errors';
import { createStore, type Readable } from '../base/store';
import { text } from '../model/jsonFields';
import type { Layer } from '../model/layers';

/** The bytes of a file of the show, by its hash. */
export type FileOf = (hash: string) => Promise<Uint8Array>;

/** Pictures that layers project on the floor, on their way to the worker. */
export interface LayerPictures {
  /** Fetches the files of these layers' pictures, each file once. */
  want(layers: readonly Layer[]): void;
  /** Whether a layer's picture, if it has one, is on its way. */
  isWaiting(layer: Layer): boolean;
  /** Hands out, once, a file that the worker has to decode; undefined: none waits. */
  next(): PictureFile | undefined;
  /** The worker has decoded a file; `error`: why it cannot, null if it did. */
  decoded(hash: string, error: string | null): void;
  /** Why pictures cannot be shown, by hash. */
  errors: Readable<ReadonlyMap<string, string>>;
}

export interface PictureFile {
  hash: string;
  bytes: Uint8Array;
}

/** The hash of the picture of a layer; null: it has none. */
export const pictureOf = ({ kind, settings }: Layer): string | null =>
  ((kind === 'picture' || kind === 'sequence') && text(settings.picture)) || null;

/** `changed` is called once a file is there, or cannot be. */
export function createLayerPictures(fileOf: FileOf, changed: () => void): LayerPictures {
  const errors = createStore<ReadonlyMap<string, string>>(new Map());
  /** By hash: true while the picture is fetched or waits to be decoded. */
  const known = new Map<string, boolean>();
  let waiting: PictureFile[] = [];
  const fail = (hash: string, why: string) => {
    known.set(hash, false);
    errors.update((all) => new Map(all).set(hash, why));
  };
  const fetchFile = async (hash: string) => {
    try {
      const bytes = await fileOf(hash);
      waiting.push({ hash, bytes });
    } catch (error) {
      const why = messageOf(error);
      fail(hash, `The picture's file cannot be loaded: ${why}`);
    }
    changed();
  };
  return {
    errors,
    want(layers) {
      const hashes = new Set(layers.flatMap((layer) => pictureOf(layer) ?? []));
      for (const hash of hashes) {
        if (known.has(hash)) continue;
        known.set(hash, true);
        void fetchFile(hash);
      }
    },
    isWaiting(layer) {
      const hash = pictureOf(layer);
      return hash !== null && known.get(hash) === true;
    },
    next() {
      const [first] = waiting;
      waiting = waiting.slice(1);
      return first;
    },
    decoded(hash, error) {
      if (error === null) known.set(hash, false);
      else fail(hash, error);
    },
  };
}
