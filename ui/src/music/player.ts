/** Where sound comes out. Its clock is that of its device, seconds. */
export interface SoundOut {
  /** The moment of its clock that is heard at this moment of the page; null: it is not known yet. */
  heard_s(now_ms: number): number | null;
  /** The moment of its clock that is made now: what starts must not start before it. */
  made_s(): number;
  /** Plays from a position of the file, beginning at a moment of the clock. */
  start(at_s: number, from_s: number): Playing;
}

/** Sound that was started. */
export interface Playing {
  /** 1: as it is; larger: faster. */
  setRate(rate: number): void;
  stop(): void;
}

/** Plays music so that its position is the one of the show. */
export interface Player {
  /** Says where the show is, seconds of the music; null: it stands. To be called ten times a second or more. */
  follow(position_s: number | null, now_ms: number): void;
  /** How far the sound that is heard is ahead of the show when `follow` was called last, seconds; null: none is heard. */
  ahead_s(): number | null;
  stop(): void;
}

/** Sound that is off by less is left alone, seconds. */
const NEAR_S = 0.003;

/** Sound that is off by more begins anew at the right place, seconds: half of what people notice between sound and light. */
const FAR_S = 0.03;

/** Sound is made faster or slower by at most this share: the change of pitch is too small to be heard. */
const RATE_MAX = 0.005;

/** Time in which an error is to be gone, seconds. */
const GONE_IN_S = 2;

/** Least time between starting and hearing, seconds: what starts late is cut off. */
const LEAD_S = 0.1;

export function createPlayer(out: SoundOut, lasts_s: number): Player {
  let playing: Playing | null = null;
  /** At this moment of the device's clock, this position of the file is played, and then at this rate. */
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
    // Before the music begins, it waits for that; what has ended does not start.
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
