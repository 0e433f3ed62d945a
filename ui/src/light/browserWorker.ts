import type { LightWorker } from './asking';

/** A worker with the module, which the browser loads only now. */
export const startLightWorker = (): LightWorker =>
  new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'light' });
