import type { WorkerLike } from './maker';

/** A worker with the module, which the browser loads only now. */
export const startWorker = (): WorkerLike =>
  new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'make' });
