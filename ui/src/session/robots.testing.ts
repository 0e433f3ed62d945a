import { ROBOT_COLUMNS, type FleetRow, type Robots } from '../api/types.gen';

/** Robots for tests, from plain lists. Without a list: place 0, 0, red, status 0; all other numbers NaN. */
export function robotsOf(lists: Partial<Record<keyof Robots, number[]>>): Robots {
  const count = Math.max(1, ...Object.values(lists).map((list) => list.length));
  const otherwise: Partial<Record<keyof Robots, number>> = {
    x: 0,
    y: 0,
    colour: 0xff0000,
    status: 0,
  };
  return Object.fromEntries(
    ROBOT_COLUMNS.map(([name, Numbers]) => [
      name,
      Numbers.from(lists[name] ?? Array<number>(count).fill(otherwise[name] ?? NaN)),
    ]),
  ) as unknown as Robots;
}

/** A row of the fleet table for tests: a simulated robot that can drive, changed by `over`. */
export const robotRow = (over: Partial<FleetRow> = {}): FleetRow => ({
  id: 'a1b2c3d4',
  status: 'idle',
  presence: 'active',
  age_s: 0,
  battery: 80,
  battery_left_s: null,
  pixel: null,
  firmware: null,
  abilities: { route: true, fade: true, blink: true },
  clock_us: 5,
  called: null,
  admitted: true,
  simulated: true,
  preflight: null,
  ...over,
});
