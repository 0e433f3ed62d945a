import type { Phase } from '../api/types.gen';

/** Whether robots drive, or stand in the middle of a show. */
export const isRunning = (phase: Phase) => phase !== 'idle' && phase !== 'ready';
