import type { FleetRow } from '../api/types.gen';

/** Whether robots move anything real. One real robot makes a real fleet. */
export type FleetKind = 'simulated' | 'real';

type Row = Pick<FleetRow, 'simulated'>;

/** Kind of the fleet; null: no robot is known. */
export function fleetKind(rows: readonly Row[]): FleetKind | null {
  if (rows.length === 0) return null;
  return rows.every((row) => row.simulated) ? 'simulated' : 'real';
}

export const KIND_WORDS = { simulated: 'Simulated robots', real: 'Real robots' } as const;

/** Explains the kind, for the badge's tooltip. */
export function kindHint(rows: readonly Row[]): string {
  const real = rows.filter((row) => !row.simulated).length;
  if (real === 0) return 'All robots are simulated: nothing moves but on this screen.';
  if (real === rows.length)
    return 'Robots really move. A robot that does not say that it is simulated is real.';
  return `${real} of ${rows.length} robots ${real === 1 ? 'is' : 'are'} real, the others are simulated.`;
}

/** Where robots drive without a show: to a frame, counted from 0, or to their starting places. */
export type DriveGoal = number | 'home';

/** The question before real robots drive somewhere. */
export function driveQuestion(rows: readonly Row[], goal: DriveGoal): string {
  const where = goal === 'home' ? 'their starting places' : `frame ${goal + 1}`;
  const [all, real] = [rows.length, rows.filter((row) => !row.simulated).length];
  const robots = `${all} ${all === 1 ? 'robot' : 'robots'}`;
  if (real < all) return `Drive ${robots} to ${where}, ${real} of them real?`;
  return `Drive ${all} real ${all === 1 ? 'robot' : 'robots'} to ${where}?`;
}
