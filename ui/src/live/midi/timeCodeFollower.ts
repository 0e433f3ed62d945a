/** The state of the show when it is compared with time code. */
export interface FollowedShow {
  /** Whether a show can be played now. */
  isReady: boolean;
  isPlaying: boolean;
  /** Whether the show waits for GO. */
  waits: boolean;
  /** Seconds from the start of the first frame's air time, negative before it; null: the show stands. */
  show_s: number | null;
}

/** What following asks for. */
export interface FollowerActs {
  play(): void;
  pause(): void;
  /** Tells people something. */
  say(message: string): void;
}

/** Lets time code start a show, and pauses the show when the code stops, or jumps away from it. */
export interface TimeCodeFollower {
  /**
   * Call this often. `code_s`: the time code now, seconds, null: none runs; `start_s`: its time at which the show is
   * played; `now_ms`: this screen's clock.
   */
  step(code_s: number | null, start_s: number, show: FollowedShow, now_ms: number): void;
}

/** Seconds by which code and show may drift apart; beyond that the show is paused: robots do not chase the code. */
export const APART_MAX_S = 0.5;
/** The code starts the show only if it has passed the start by less than this, seconds; else it has jumped past it. */
const START_WINDOW_S = 0.5;
/** Code that is silent for longer than this was stopped, milliseconds. */
const STOPPED_MS = 500;

export function createTimeCodeFollower(acts: FollowerActs): TimeCodeFollower {
  let before_s: number | null = null;
  /** Code minus show time, seconds, at their first comparison since the show began or went on; null: none yet. */
  let base_s: number | null = null;
  let heard_ms = -Infinity;
  const leave = (message: string) => {
    base_s = null;
    acts.pause();
    acts.say(message);
  };
  return {
    step(code_s, start_s, show, now_ms) {
      const passes =
        code_s !== null &&
        before_s !== null &&
        before_s < start_s &&
        code_s >= start_s &&
        code_s - start_s < START_WINDOW_S;
      before_s = code_s;
      if (code_s !== null) heard_ms = now_ms;
      if (passes && show.isReady) acts.play();
      // After a pause and after GO, the offset of the code to the show is measured anew.
      if (!show.isPlaying || show.waits) base_s = null;
      if (!show.isPlaying || show.show_s === null || show.show_s < 0) return;
      if (code_s === null) {
        if (base_s !== null && now_ms - heard_ms > STOPPED_MS)
          leave('Time code has stopped: the show is paused.');
        return;
      }
      base_s ??= code_s - show.show_s;
      const apart_s = code_s - show.show_s - base_s;
      if (Math.abs(apart_s) <= APART_MAX_S) return;
      const way = apart_s > 0 ? 'ahead of' : 'behind';
      const by_s = Math.abs(apart_s).toFixed(1);
      leave(`Time code is ${by_s} s ${way} the show, which is paused. Resume plays it from here.`);
    },
  };
}
