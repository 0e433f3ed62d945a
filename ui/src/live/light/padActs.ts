import type { Operation } from '../../api/types.gen';

/** What pads can do beside lights, in the order of their numbers after the lights. */
export const PAD_ACTS: readonly { title: string; operation: Operation }[] = [
  { title: 'GO', operation: { do: 'go' } },
  { title: 'Stop all', operation: { do: 'stop_all' } },
];
