/** A sound device. Its clock counts seconds. */
export interface SoundOut {
  /** The moment of the device's clock that is heard at `now_ms` of the page's clock; null: not known yet. */
  heard_s(now_ms: number): number | null;
  /** The moment of the device's clock for which sound is made now: a start before it comes too late. */
  made_s(): number;
  /** Plays from position `from_s` of the file, beginning at `at_s` of the device's clock. */
  start(at_s: number, from_s: number): Playing;
}

/** Sound that was started. */
export interface Playing {
  /** 1: the file's own speed; larger: faster. */
  setRate(rate: number): void;
  stop(): void;
}

/** Plays music so that its heard position follows that of the show. */
export interface Player {
  /** Says where the show is now, seconds of the music; null: it stands, and sound stops. Call it ten times a second. */
  follow(position_s: number | null, now_ms: number): void;
  /** How far the sound was ahead of the show at the last `follow`, seconds; null: not compared since it began. */
  ahead_s(): number | null;
  stop(): void;
}

/** Sound that is off by less than this plays at its own speed, seconds. */
const NEAR_S = 0.003;

/** Sound that is off by more than this begins anew at the right place, seconds: half of what people notice. */
const FAR_S = 0.03;

/** Sound is made faster or slower by at most this share: the change of pitch is too small to be heard. */
const RATE_MAX = 0.005;

/** Time in which a small error is to be gone, seconds; larger values correct more slowly. */
const GONE_IN_S = 2;

/** Least time from a start to when it is heard, seconds: the begin of sound that starts too late is cut off. */
const LEAD_S = 0.1;

export function createPlayer(out: SoundOut, lasts_s: number): Player {
  let playing: Playing | null = null;
  /** At `clock_s` of the device's clock, `position_s` of the file is heard, and from then on at `rate`. */
  let since = { clock_s: 0, position_s: 0, rate: 1 };
  let ahead: number | null = null;
  const positionAt = (clock_s: number) => since.position_s + (clock_s - since.clock_s) * since.rate;
  const stop = () => {
    playing?.stop();
    playing = null;
    ahead = null;
  };
  const begin = (position_s: number, heard_s: number) => {
    stop();
    const lead_s = Math.max(LEAD_S, out.made_s() - heard_s + LEAD_S / 2);
    // Before second 0 of the file, the start waits until then. After the end of the file, nothing starts.
    const [from_s, late_s] = [Math.max(0, position_s + lead_s), Math.max(0, -position_s - lead_s)];
    if (from_s >= lasts_s) return;
    since = { clock_s: heard_s + lead_s + late_s, position_s: from_s, rate: 1 };
    playing = out.start(since.clock_s, from_s);
  };
  return {
    follow(position_s, now_ms) {
      const heard_s = out.heard_s(now_ms);
      if (position_s === null || heard_s === null) return stop();
      if (!playing) return begin(position_s, heard_s);
      if (position_s > lasts_s) return stop();
      ahead = positionAt(heard_s) - position_s;
      if (Math.abs(ahead) > FAR_S) return begin(position_s, heard_s);
      if (heard_s < since.clock_s) return;
      const wanted = ahead / GONE_IN_S;
      const rate =
        Math.abs(ahead) < NEAR_S ? 1 : 1 - Math.min(RATE_MAX, Math.max(-RATE_MAX, wanted));
      if (rate === since.rate) return;
      since = { clock_s: heard_s, position_s: positionAt(heard_s), rate };
      playing.setRate(rate);
    },
    ahead_s: () => ahead,
    stop,
  };
}
