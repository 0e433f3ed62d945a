import type { Transition } from '../api/types.gen';
import { listenTo, type WorkerLike } from '../base/worker';
import { pictureOf, type FileOf, type PictureFile } from '../light/pictures';
import { writeShow } from '../model/json';
import { layersOf } from '../model/layers';
import type { Show } from '../model/show';
import type { FilmAsk, FilmMusic, FilmReply, FilmSettings } from './protocol';

export type FilmWorker = WorkerLike<FilmAsk, FilmReply>;

/** A film on its way. */
export interface Filming {
  /** The finished file. Rejects with a message for people; does not settle any more after `cancel`. */
  film: Promise<Uint8Array<ArrayBuffer>>;
  cancel(): void;
}

/**
 * Makes a film of a planned show in a worker. `progress` gets the share that is painted, 0 to 1. Pictures of layers
 * that cannot be loaded are left out.
 */
export function startFilm(
  start: () => FilmWorker,
  { show, transitions }: { show: Show; transitions: readonly Transition[] },
  { settings, music }: { settings: FilmSettings; music: FilmMusic | null },
  fileOf: FileOf,
  progress: (share: number) => void,
): Filming {
  const worker = start();
  let isWanted = true;
  const end = () => {
    isWanted = false;
    worker.terminate();
  };
  const film = new Promise<Uint8Array<ArrayBuffer>>((done, fail) => {
    const take = (reply: FilmReply) => {
      if (!isWanted) return;
      if (reply.of === 'painted') return progress(reply.picture / reply.pictures);
      end();
      if (reply.of === 'film') done(new Uint8Array(reply.bytes));
      else fail(new Error(reply.message));
    };
    const broken = { of: 'failure', message: 'The film could not be made: not enough memory?' };
    listenTo(worker, () => (isWanted ? worker : null), take, broken as FilmReply);
    void picturesOf(show, fileOf).then((pictures) => {
      if (!isWanted) return;
      const request = { show: writeShow(show), transitions: [...transitions] };
      worker.postMessage({ request, pictures, settings, music });
    });
  });
  return { film, cancel: end };
}

/** The files of pictures that layers project. */
async function picturesOf(show: Show, fileOf: FileOf): Promise<PictureFile[]> {
  const hashes = [...new Set(layersOf(show).flatMap((layer) => pictureOf(layer) ?? []))];
  const files = hashes.map((hash) =>
    fileOf(hash).then(
      (bytes) => [{ hash, bytes }],
      () => [],
    ),
  );
  return (await Promise.all(files)).flat();
}
