import { fleetKind, type DriveGoal } from './fleetKind';
import type { Session } from './session';
import { whenPlanned } from './start';

/** Drives robots to a frame or home. If the fleet has a real robot, the user is asked first. */
export function driveTo(session: Session, goal: DriveGoal) {
  if (fleetKind(session.live.fleet.get().rows) === 'real') session.driveAsked.set(goal);
  else driveNow(session, goal);
}

/** Drives robots to a frame or home without a question. A drive to a frame waits until the show is planned. */
export function driveNow(session: Session, goal: DriveGoal) {
  if (goal === 'home') void session.ask({ do: 'home' });
  else whenPlanned(session, () => void session.ask({ do: 'preview', frame: goal }));
}
