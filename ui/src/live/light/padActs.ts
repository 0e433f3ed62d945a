import type { Operation } from '../../api/types.gen';

/** What pads can do beside pressing lights; their numbers follow those of the lights in this order. */
export const PAD_ACTS: readonly { title: string; operation: Operation }[] = [
  { title: 'GO', operation: { do: 'go' } },
  { title: 'Stop all', operation: { do: 'stop_all' } },
];
