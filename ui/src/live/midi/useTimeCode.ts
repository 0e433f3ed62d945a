import { useEffect, useMemo } from 'react';
import { createStore, type Store } from '../../base/store';
import { notify } from '../../session/notices';
import { createChoice } from '../../session/preferences';
import { useSession, type Session } from '../../session/session';
import { createTimeCode, readClock } from './timeCode';
import { createTimeCodeFollower } from './timeCodeFollower';

/** Period at which code and show are compared, milliseconds. */
const STEP_MS = 50;

/** Time of the code at which the show is played, such as `01:00:00`; kept on this screen. */
export const startClock = createChoice<string>(
  'lightbots-time-code',
  '01:00:00',
  (text): text is string => text !== null && readClock(text) !== null,
);

/** Time code that this screen hears. */
export interface LiveTimeCode {
  /** Whether the code starts and pauses shows. */
  isOn: Store<boolean>;
  /** The code now, seconds since its midnight; null: no code runs. */
  code_s: Store<number | null>;
  /** Takes a message of a MIDI device. */
  hear: (data: Uint8Array) => void;
}

/** Follows time code on this page; only if it is switched on and the person `mayPlay`, it starts and pauses shows. */
export function useTimeCode(mayPlay: boolean): LiveTimeCode {
  const session = useSession();
  const code = useMemo(() => createTimeCode(), []);
  const live = useMemo(
    () => ({
      isOn: createStore(false),
      code_s: createStore<number | null>(null),
      hear: (data: Uint8Array) => code.hear(data, performance.now()),
    }),
    [code],
  );
  useEffect(() => {
    const follower = createTimeCodeFollower(actsOf(session));
    const timer = setInterval(() => {
      const now_ms = performance.now();
      const code_s = code.now_s(now_ms);
      live.code_s.set(code_s);
      if (!live.isOn.get() || !mayPlay) return;
      follower.step(code_s, readClock(startClock.get()) ?? 0, showOf(session, now_ms), now_ms);
    }, STEP_MS);
    return () => clearInterval(timer);
  }, [session, code, live, mayPlay]);
  return live;
}

const actsOf = ({ ask }: Session) => ({
  play: () => void ask({ do: 'play', from: 0, missing: 'refuse' }),
  pause: () => void ask({ do: 'pause' }),
  say: (message: string) => notify('error', message),
});

function showOf({ live }: Session, now_ms: number) {
  const { phase, cue } = live.playback.get();
  const position_s = live.pace.get() === 1 ? live.showClock.position_s(now_ms) : null;
  return {
    isReady: phase === 'ready',
    isPlaying: phase === 'playing',
    waits: cue !== null,
    show_s: position_s,
  };
}
