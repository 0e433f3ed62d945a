import type { MakeWorker } from './maker';

/** Starts a worker that makes frames. Only now does the browser load its script. */
export const startWorker = (): MakeWorker =>
  new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'make' });
