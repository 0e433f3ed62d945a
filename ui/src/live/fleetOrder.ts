import type { FleetRow } from '../api/types.gen';
import { nameOf } from '../session/robotWords';

/** What the table of robots is sorted by. */
export type Order = 'pixel' | 'robot' | 'state' | 'charge';

export interface Arrangement {
  by: Order;
  /** From the largest to the smallest. */
  down: boolean;
  /** Part of a robot's name or id, in any case of letters; empty: all robots. */
  search: string;
}

/** Statuses, the worst first. Presence counts before status. */
const WORST_FIRST = ['faulty', 'lost', 'cut', 'held', 'driving', 'ready', 'idle'] as const;
const PRESENCES = ['gone', 'stale', 'active'] as const;

const trouble = (row: FleetRow) =>
  PRESENCES.indexOf(row.presence) * WORST_FIRST.length + WORST_FIRST.indexOf(row.status);

const names = new Intl.Collator('en', { numeric: true });

/** Comparisons by column; `sign` is -1 for down. Robots without a pixel or a known charge come last either way. */
const ORDERS: Record<Order, (a: FleetRow, b: FleetRow, sign: number) => number> = {
  pixel: (a, b, sign) => unknownLast(a.pixel, b.pixel, sign),
  robot: (a, b, sign) => sign * names.compare(nameOf(a), nameOf(b)),
  state: (a, b, sign) => sign * (trouble(a) - trouble(b)),
  charge: (a, b, sign) => unknownLast(a.battery, b.battery, sign),
};

function unknownLast(a: number | null, b: number | null, sign: number): number {
  if (a === null || b === null) return Number(a === null) - Number(b === null);
  return sign * (a - b);
}

/** The robots that a search finds, in order; equal ones by name, upwards. */
export function arranged(rows: readonly FleetRow[], { by, down, search }: Arrangement): FleetRow[] {
  const sought = search.trim().toLowerCase();
  const fits = (row: FleetRow) =>
    sought === '' || `${row.called ?? ''} ${row.id}`.toLowerCase().includes(sought);
  const sign = down ? -1 : 1;
  return rows
    .filter(fits)
    .sort((a, b) => ORDERS[by](a, b, sign) || names.compare(nameOf(a), nameOf(b)));
}
