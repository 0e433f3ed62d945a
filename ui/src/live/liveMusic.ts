import { messageOf } from '../base/errors';
import { getAsset } from '../api/http';
import { createStore, type Readable } from '../base/store';
import { musicOf } from '../model/beats';
import { createSounding } from '../music/sounding';
import type { Live } from '../session/live';
import { notify } from '../session/notices';
import { createChoice } from '../session/preferences';

/** The music of the running show, heard on this screen. */
export interface LiveMusic {
  /** Whether the sound of this screen is switched on. */
  isOn: Readable<boolean>;
  /** Switches the sound on or off; to be called in a press of the user. */
  toggle(): void;
  stop(): void;
}

/** Period at which sound is compared with the show, milliseconds. Browsers make it longer in hidden pages. */
const STEP_MS = 50;

/** Greatest offset that the user can set, earlier or later, milliseconds. */
export const OFFSET_MAX_MS = 500;

const isOffset = (text: string | null): text is string =>
  text !== null && Math.abs(Number(text)) <= OFFSET_MAX_MS;

/** How much earlier the music is played than the show has it, milliseconds, as text; negative: later. */
export const musicOffset = createChoice<string>('lightbots-music-offset', '0', isOffset);

export function createLiveMusic(live: Live): LiveMusic {
  const isOn = createStore(false);
  const sounding = createSounding(getAsset);
  let timer: ReturnType<typeof setInterval> | undefined;
  const stop = () => {
    clearInterval(timer);
    sounding.close();
    isOn.set(false);
  };
  const follow = () => {
    const now_ms = performance.now();
    const isReal = live.pace.get() === 1;
    const at_s = isReal ? live.showClock.position_s(now_ms) : null;
    sounding.follow(at_s === null ? null : at_s + Number(musicOffset.get()) / 1000, now_ms);
  };
  return {
    isOn,
    toggle() {
      if (isOn.get()) return stop();
      const { show } = live.opened.get();
      const file = show && musicOf(show);
      if (!file) return;
      isOn.set(true);
      timer = setInterval(follow, STEP_MS);
      sounding.open(file.hash).catch((error: unknown) => {
        stop();
        notify('error', messageOf(error));
      });
    },
    stop,
  };
}
