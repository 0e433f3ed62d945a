import type { Phase } from '../api/types.gen';

/** True in every phase except `idle` and `ready`: a show or a drive is under way, even if paused. */
export const isRunning = (phase: Phase) => phase !== 'idle' && phase !== 'ready';
