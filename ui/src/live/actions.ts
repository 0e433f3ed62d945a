import type { Phase, Playback } from '../api/types.gen';

export type Action =
  | 'play'
  | 'pause'
  | 'resume'
  | 'go_on'
  | 'abort'
  | 'step'
  | 'go'
  | 'jump'
  | 'skip'
  | 'preview'
  | 'home'
  | 'loop'
  | 'refresh';

/** The enabled actions, and the action of the large button. */
export interface Actions {
  main: 'play' | 'pause' | 'resume' | 'go_on';
  enabled: ReadonlySet<Action>;
}

const MAIN: Partial<Record<Phase, Actions['main']>> = {
  paused: 'resume',
  playing: 'pause',
  link_lost: 'go_on',
};

export function actionsOf(
  phase: Phase,
  linked: boolean,
  hasShow: boolean,
  mayGoOn = false,
  waitsForGo = false,
  mayJump = false,
): Actions {
  const main = MAIN[phase] ?? 'play';
  const enabled = new Set<Action>();
  if (!linked) return { main, enabled };
  enabled.add('loop');
  if (phase !== 'idle') enabled.add('refresh');
  if (phase === 'ready' && hasShow)
    for (const a of ['play', 'preview', 'home'] as const) enabled.add(a);
  if (phase === 'playing') enabled.add('pause');
  if (phase === 'playing' && waitsForGo) enabled.add('go');
  if (mayJump) for (const a of ['jump', 'skip'] as const) enabled.add(a);
  if (phase === 'ready' && hasShow) enabled.add('jump');
  if (phase === 'paused') for (const a of ['resume', 'step'] as const) enabled.add(a);
  if (phase === 'link_lost' && mayGoOn) enabled.add('go_on');
  if (RUNNING.has(phase)) enabled.add('abort');
  return { main, enabled };
}

/** Whether GO does something: a frame waits for it, or frames repeat until GO and it was not given yet. */
export const takesGo = ({ cue, repeats }: Pick<Playback, 'cue' | 'repeats'>): boolean =>
  cue !== null || (repeats !== null && !repeats.leaves);

/** Phases in which a run can be aborted. */
const RUNNING: ReadonlySet<Phase> = new Set<Phase>([
  'preparing',
  'playing',
  'paused',
  'preview',
  'link_lost',
]);

/** Whether an interrupted show waits for nothing but the operator. */
export function asksToGoOn({ phase, doing }: Pick<Playback, 'phase' | 'doing'>): boolean {
  return phase === 'link_lost' && doing === 'waiting for you to go on';
}

/** What the server says of a run that waits for robots to set their clocks. */
const CLOCKS = 'waiting for robots to set their clocks';

/** The state of the show in a few words. */
export function phaseText(
  playback: Pick<
    Playback,
    'phase' | 'doing' | 'frame' | 'frames' | 'failure' | 'stopped_in' | 'preflight'
  >,
): string {
  const { phase, doing, frame, frames, failure, stopped_in } = playback;
  const tested = playback.preflight?.doing ?? null;
  const where = frame === null ? '' : `frame ${frame + 1} of ${frames}`;
  switch (phase) {
    case 'idle':
      return 'No broker';
    case 'ready':
      return failure !== null ? 'Show stopped' : stopped_in === null ? 'Ready' : 'Stopped';
    case 'preparing':
      return doing === CLOCKS ? 'Waiting for robots to set their clocks' : 'Getting ready';
    case 'playing':
      if (doing === 'waiting for GO') return `Waiting for GO, ${where}`;
      return `Playing ${where}`.trim();
    case 'paused':
      return `Paused, ${where}`.replace(/, $/, '');
    case 'preview':
      if (tested !== null) return `Preflight: ${tested}`;
      return frame === null ? 'Driving home' : `Driving to ${where}`;
    case 'aborting':
      return failure === null ? 'Stopping' : 'Show stopped';
    case 'link_lost':
      return doing === null ? 'Link lost' : `Link lost, ${doing}`;
  }
}
