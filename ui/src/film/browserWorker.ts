import type { FilmWorker } from './filming';

/** A worker with the module and the encoder, which the browser loads only now. */
export const startFilmWorker = (): FilmWorker =>
  new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'film' });
