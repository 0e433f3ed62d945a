/** MIDI time code as quarter frames tell it. */
export interface TimeCode {
  /** Takes a message of a MIDI device. */
  hear(data: Uint8Array, now_ms: number): void;
  /** The time now, seconds since midnight of the code; null: no code runs. */
  now_s(now_ms: number): number | null;
}

const QUARTER_FRAME = 0xf1;
/** A time is spread over this number of messages. */
const PIECES = 8;
/** Frames a second by the two bits that tell them. */
const RATES = [24, 25, 29.97, 30] as const;
/** Drop-frame code counts 30 frames a second and leaves out two numbers a minute, but not each tenth minute. */
const DROP = 2;
/** Code of which nothing was heard for longer stands, milliseconds: quarter frames come every 8 to 10. */
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
      // Pieces of code that runs backwards, or of which one was lost, tell no time.
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

/** The time at the last of eight pieces: it says the moment of the first, seven quarters of a frame before. */
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

/** A time as `01:02:03.5`; null where a text is none. */
export function readClock(text: string): number | null {
  const parts = /^(\d{1,2}):(\d{1,2}):(\d{1,2}(?:[.,]\d+)?)$/.exec(text.trim());
  if (!parts) return null;
  const [hours, minutes, seconds] = parts.slice(1).map((part) => Number(part.replace(',', '.')));
  if (hours === undefined || minutes === undefined || seconds === undefined) return null;
  return hours < 24 && minutes < 60 && seconds < 60 ? 3600 * hours + 60 * minutes + seconds : null;
}

/** Seconds as `01:02:03.5`. */
export function codeText(time_s: number): string {
  const tenths = Math.floor(time_s * 10 + 1e-6);
  const [hours, minutes] = [Math.floor(tenths / 36_000), Math.floor(tenths / 600) % 60];
  const two = (value: number) => String(value).padStart(2, '0');
  return `${two(hours)}:${two(minutes)}:${two(Math.floor(tenths / 10) % 60)}.${tenths % 10}`;
}
