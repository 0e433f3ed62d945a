import { fleetKind, type DriveGoal } from './fleetKind';
import type { Session } from './session';
import { whenPlanned } from './start';

/** Drives robots there. Real robots drive only after a confirmation. */
export function driveTo(session: Session, goal: DriveGoal) {
  if (fleetKind(session.live.fleet.get().rows) === 'real') session.driveAsked.set(goal);
  else driveNow(session, goal);
}

/** Drives robots there without a question. */
export function driveNow(session: Session, goal: DriveGoal) {
  if (goal === 'home') void session.ask({ do: 'home' });
  else whenPlanned(session, () => void session.ask({ do: 'preview', frame: goal }));
}
