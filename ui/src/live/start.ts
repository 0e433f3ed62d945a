import type { Session } from '../shell/session';
import { checklistOf, isReady, type Check } from './checklist';

/** The checklist as things are now. */
export const checkNow = ({ live }: Session): Check[] =>
  checklistOf({
    broker: live.broker.get(),
    show: live.opened.get().show,
    plan: live.plan.get(),
    rows: live.fleet.get().rows,
    robots: live.track.latest(),
  });

/** Plays from the chosen frame if all is well; otherwise shows what is missing first. */
export function startPlay(session: Session) {
  if (isReady(checkNow(session)))
    void session.ask({ do: 'play', from: session.frame.get(), missing: 'refuse' });
  else session.checking.set(true);
}
