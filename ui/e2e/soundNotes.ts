/** Measurements of a page about its music and the show. */
export interface SoundNotes {
  /** How many times music was started. */
  starts: number;
  /** How many times music was stopped. */
  stops: number;
  /** Time by which music is ahead of the show by the sound device's clock, milliseconds. */
  ahead_ms: number[];
  /** Show time at each of these measurements, seconds. */
  at_s: number[];
  /** Show time, seconds, at moments of the machine's clock, milliseconds. */
  shows: { wall_ms: number; show_s: number; runs: boolean }[];
}

/** Runs in a page before its scripts: counts starts and stops of music, and measures the time by which it is ahead. */
export function noteSound() {
  const sound: SoundNotes = { starts: 0, stops: 0, ahead_ms: [], at_s: [], shows: [] };
  Object.assign(globalThis, { sound });
  let since: { node: AudioBufferSourceNode; at_s: number; from_s: number; rate: number } | null =
    null;
  const { start, stop } = AudioBufferSourceNode.prototype;
  AudioBufferSourceNode.prototype.start = function (at_s = 0, from_s = 0) {
    sound.starts++;
    since = { node: this, at_s, from_s, rate: 1 };
    start.call(this, at_s, from_s);
  };
  AudioBufferSourceNode.prototype.stop = function () {
    sound.stops++;
    since = null;
    stop.call(this);
  };
  // This does not rely on the page's code: the difference of clocks is taken from the message with the smallest delay.
  let [offset_ms, handled] = [Infinity, 0];
  const RealSocket = globalThis.WebSocket;
  globalThis.WebSocket = class extends RealSocket {
    constructor(...more: ConstructorParameters<typeof RealSocket>) {
      super(...more);
      this.addEventListener('message', ({ data }) => {
        if (typeof data !== 'string' || !data.includes('"show_time"')) return;
        const { at_ms, show_time } = JSON.parse(data) as {
          at_ms: number;
          show_time: { show_s: number; runs: boolean } | null;
        };
        const now_ms = performance.now();
        offset_ms = Math.min(offset_ms, now_ms - at_ms);
        const wall_ms = performance.timeOrigin + at_ms + offset_ms;
        if (show_time) sound.shows.push({ wall_ms, ...show_time });
        if (!since || !show_time?.runs || ++handled < 40) return;
        const { contextTime = 0, performanceTime = 0 } = (
          since.node.context as AudioContext
        ).getOutputTimestamp();
        const heard_s = contextTime + (now_ms - performanceTime) / 1000;
        if (heard_s < since.at_s) return;
        const show_s = show_time.show_s + (now_ms - offset_ms - at_ms) / 1000;
        const position_s = since.from_s + (heard_s - since.at_s) * since.rate;
        // The player makes the music a little faster or slower.
        const rate = since.node.playbackRate.value;
        if (rate !== since.rate) since = { ...since, at_s: heard_s, from_s: position_s, rate };
        sound.ahead_ms.push(1000 * (position_s - show_s));
        sound.at_s.push(show_s);
      });
    }
  };
}
