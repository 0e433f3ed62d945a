import type { FilmWorker } from './filming';

/** Starts a worker that makes a film. Only now does the browser load its script. */
export const startFilmWorker = (): FilmWorker =>
  new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'film' });
