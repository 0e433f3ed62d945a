import type { MakeWorker } from './maker';

/** A worker with the module, which the browser loads only now. */
export const startWorker = (): MakeWorker =>
  new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'make' });
