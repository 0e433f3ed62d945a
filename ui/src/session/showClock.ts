import type { ShowTime } from '../api/types.gen';

/** Where the show is on its timeline now, on this screen's clock. */
export interface ShowClock {
  /** The server said where the show was at `at_ms` of its clock. `now_ms`: this screen's clock at that message. */
  hear(at_ms: number, time: ShowTime | null, now_ms: number): void;
  /** Seconds from the start of the first frame's air time; null: the show stands, none is played, or silence. */
  position_s(now_ms: number): number | null;
}

/** The clocks' offset is taken from messages of this time, milliseconds. They drift by less than 1 ms in it. */
const WINDOW_MS = 10_000;
/** After this time without a message, milliseconds, the connection counts as lost and no position is known. */
const SILENT_MS = 2_000;

export function createShowClock(): ShowClock {
  /** Messages of the last `WINDOW_MS`: when each came, and this screen's clock minus the server's in it. */
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
      // A delay only adds to an offset: the smallest one belongs to the message that was delayed least.
      const offset_ms = Math.min(...offsets.map((one) => one.offset_ms));
      return last.time.show_s + (now_ms - offset_ms - last.at_ms) / 1000;
    },
  };
}
