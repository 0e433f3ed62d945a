import type { ShowTime } from '../api/types.gen';

/** Where the show is on its timeline now, on this screen's clock. */
export interface ShowClock {
  /** The server said where the show was at a moment of its clock. */
  hear(at_ms: number, time: ShowTime | null, now_ms: number): void;
  /** Seconds from the start of the first frame's air time; null: the show stands, or none is played. */
  position_s(now_ms: number): number | null;
}

/** Messages of this long tell how the two clocks differ, milliseconds: clocks drift by less than a millisecond then. */
const WINDOW_MS = 10_000;
/** A show that the server has not spoken of for longer stands, milliseconds: the connection is lost. */
const SILENT_MS = 2_000;

export function createShowClock(): ShowClock {
  /** Messages of the last seconds: when they came, and how late they seemed. */
  let offsets: { came_ms: number; offset_ms: number }[] = [];
  let last: { at_ms: number; time: ShowTime | null; came_ms: number } | null = null;
  return {
    hear(at_ms, time, now_ms) {
      // Another server, or its clock began anew.
      if (last && at_ms < last.at_ms) offsets = [];
      offsets = offsets.filter(({ came_ms }) => now_ms - came_ms < WINDOW_MS);
      offsets.push({ came_ms: now_ms, offset_ms: now_ms - at_ms });
      last = { at_ms, time, came_ms: now_ms };
    },
    position_s(now_ms) {
      if (!last?.time?.runs || now_ms - last.came_ms > SILENT_MS) return null;
      // The quickest message was delayed least: all others only seem to come from an earlier clock.
      const offset_ms = Math.min(...offsets.map((one) => one.offset_ms));
      return last.time.show_s + (now_ms - offset_ms - last.at_ms) / 1000;
    },
  };
}
