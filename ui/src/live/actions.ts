import type { Phase, Playback } from '../api/types.gen';

export type Action =
  'play' | 'pause' | 'resume' | 'abort' | 'step' | 'preview' | 'loop' | 'refresh';

/** The enabled actions, and the action of the large button. */
export interface Actions {
  main: 'play' | 'pause' | 'resume';
  enabled: ReadonlySet<Action>;
}

export function actionsOf(phase: Phase, linked: boolean, hasShow: boolean): Actions {
  const main = phase === 'paused' ? 'resume' : phase === 'playing' ? 'pause' : 'play';
  const enabled = new Set<Action>();
  if (!linked) return { main, enabled };
  enabled.add('loop');
  if (phase !== 'idle') enabled.add('refresh');
  if (phase === 'ready' && hasShow) for (const a of ['play', 'preview'] as const) enabled.add(a);
  if (phase === 'playing') enabled.add('pause');
  if (phase === 'paused') for (const a of ['resume', 'step'] as const) enabled.add(a);
  if (phase === 'preparing' || phase === 'playing' || phase === 'paused' || phase === 'preview')
    enabled.add('abort');
  return { main, enabled };
}

/** The state of the show in a few words. */
export function phaseText(
  playback: Pick<Playback, 'phase' | 'frame' | 'frames' | 'failure'>,
): string {
  const { phase, frame, frames, failure } = playback;
  const where = frame === null ? '' : `frame ${frame + 1} of ${frames}`;
  switch (phase) {
    case 'idle':
      return 'No broker';
    case 'ready':
      return failure === null ? 'Ready' : 'Show stopped';
    case 'preparing':
      return 'Getting ready';
    case 'playing':
      return `Playing ${where}`.trim();
    case 'paused':
      return `Paused, ${where}`.replace(/, $/, '');
    case 'preview':
      return `Driving to ${where}`.replace(/ to $/, '');
    case 'aborting':
      return 'Stopping';
  }
}
