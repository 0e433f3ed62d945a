import { messageOf } from '../../base/errors';
import { createStore, type Readable } from '../../base/store';
import type { Sounding } from '../../music/sounding';
import { notify } from '../../session/notices';

/** Plays the file of the music by itself, without the show. */
export interface Listening {
  /** The position that is heard, seconds of the file; null: nothing is heard. */
  at_s: Readable<number | null>;
  start(hash: string, from_s: number, lasts_s: number): Promise<void>;
  stop(): void;
}

export function createListening(sounding: Sounding): Listening {
  const at_s = createStore<number | null>(null);
  let request = 0;
  let stops = 0;
  const stop = () => {
    stops += 1;
    cancelAnimationFrame(request);
    sounding.follow(null, performance.now());
    at_s.set(null);
  };
  return {
    at_s,
    async start(hash, from_s, lasts_s) {
      stop();
      const before = stops;
      try {
        await sounding.open(hash);
      } catch (error) {
        notify('error', messageOf(error));
        return;
      }
      if (stops !== before) return;
      const began_ms = performance.now();
      const step = (now_ms: number) => {
        const position_s = from_s + Math.max(0, now_ms - began_ms) / 1000;
        if (position_s >= lasts_s) return stop();
        request = requestAnimationFrame(step);
        sounding.follow(position_s, now_ms);
        at_s.set(position_s);
      };
      request = requestAnimationFrame(step);
    },
    stop,
  };
}
