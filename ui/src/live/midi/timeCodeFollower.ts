/** Where the show is when it is compared with time code. */
export interface FollowedShow {
  /** Whether a show can be played now. */
  isReady: boolean;
  isPlaying: boolean;
  /** Whether it waits for GO. */
  waits: boolean;
  /** Seconds from the start of the first frame's air time; null: it stands, or robots are on their way there. */
  show_s: number | null;
}

/** What following asks for. */
export interface FollowerActs {
  play(): void;
  pause(): void;
  /** A line for people. */
  say(message: string): void;
}

/** Lets time code start a show, and pauses the show when the code leaves it. */
export interface TimeCodeFollower {
  /** Compares; `code_s` as `TimeCode.now_s`, `start_s` the time at which the show is played. */
  step(code_s: number | null, start_s: number, show: FollowedShow, now_ms: number): void;
}

/** Robots never chase a jump of the code: a show that is farther from it is paused, seconds. */
export const APART_MAX_S = 0.5;
/** Code that has passed the start by more did not come to it: it began later, seconds. */
const START_WINDOW_S = 0.5;
/** Code that is silent for longer was stopped, milliseconds. */
const STOPPED_MS = 500;

export function createTimeCodeFollower(acts: FollowerActs): TimeCodeFollower {
  let before_s: number | null = null;
  /** The code less the show, when they were compared first since the show goes on. */
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
      // Where the code is to the show counts anew after a pause and after GO.
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
