/** The time of MIDI time code that runs forwards, from its quarter-frame messages. */
export interface TimeCode {
  /** Takes any message of a MIDI device, `now_ms` of this screen's clock. */
  hear(data: Uint8Array, now_ms: number): void;
  /** The time now, seconds since midnight of the code; null: no code runs, or no full time has come yet. */
  now_s(now_ms: number): number | null;
}

/** Status byte of a quarter-frame message. */
const QUARTER_FRAME = 0xf1;
/** A time is spread over this number of messages. */
const PIECES = 8;
/** Frames of the code per second, by the two bits that say which. */
const RATES = [24, 25, 29.97, 30] as const;
/** Frame numbers that drop-frame code leaves out each minute, except each tenth, while it counts 30 a second. */
const DROP = 2;
/** After this time without a message, milliseconds, no code runs: quarter frames come every 8 to 10 ms. */
const SILENT_MS = 250;

export function createTimeCode(): TimeCode {
  let nibbles: number[] = [];
  let last: { code_s: number; heard_ms: number } | null = null;
  let heard_ms = -Infinity;
  return {
    hear(data, now_ms) {
      const [status, value = 0] = data;
      if (status !== QUARTER_FRAME) return;
      const piece = (value >> 4) & 7;
      // A piece out of order begins anew: one was lost, or the code runs backwards, which is not read.
      if (piece !== nibbles.length) nibbles = [];
      if (piece === nibbles.length) nibbles.push(value & 15);
      heard_ms = now_ms;
      if (nibbles.length < PIECES) return;
      last = { code_s: secondsOf(nibbles), heard_ms: now_ms };
      nibbles = [];
    },
    now_s(now_ms) {
      if (!last || now_ms - heard_ms > SILENT_MS) return null;
      return last.code_s + (now_ms - last.heard_ms) / 1000;
    },
  };
}

/** Seconds at the last of eight pieces. They name the frame of the first piece, seven quarters of a frame earlier. */
function secondsOf(nibbles: readonly number[]): number {
  const at = (piece: number) => nibbles[piece] ?? 0;
  const [frames, seconds] = [at(0) + 16 * (at(1) & 1), at(2) + 16 * (at(3) & 3)];
  const [minutes, hours] = [at(4) + 16 * (at(5) & 3), at(6) + 16 * (at(7) & 1)];
  const code = (at(7) >> 1) & 3;
  const rate = RATES[code] ?? 30;
  const whole = 60 * (60 * hours + minutes) + seconds;
  const now = frames + (PIECES - 1) / 4;
  if (code !== 2) return whole + now / rate;
  const all = 60 * hours + minutes;
  return (30 * whole + now - DROP * (all - Math.floor(all / 10))) / rate;
}

/** Reads a time such as `01:02:03.5` into seconds since midnight; null: the text is no time of a day. */
export function readClock(text: string): number | null {
  const parts = /^(\d{1,2}):(\d{1,2}):(\d{1,2}(?:[.,]\d+)?)$/.exec(text.trim());
  if (!parts) return null;
  const [hours, minutes, seconds] = parts.slice(1).map((part) => Number(part.replace(',', '.')));
  if (hours === undefined || minutes === undefined || seconds === undefined) return null;
  return hours < 24 && minutes < 60 && seconds < 60 ? 3600 * hours + 60 * minutes + seconds : null;
}

/** Seconds since midnight as `01:02:03.5`, rounded down to a tenth. */
export function codeText(time_s: number): string {
  const tenths = Math.floor(time_s * 10 + 1e-6);
  const [hours, minutes] = [Math.floor(tenths / 36_000), Math.floor(tenths / 600) % 60];
  const two = (value: number) => String(value).padStart(2, '0');
  return `${two(hours)}:${two(minutes)}:${two(Math.floor(tenths / 10) % 60)}.${tenths % 10}`;
}
