import type { LightWorker } from './asking';

/** Starts a light worker. Only now does the browser load its script. */
export const startLightWorker = (): LightWorker =>
  new Worker(new URL('./worker.ts', import.meta.url), { type: 'module', name: 'light' });
