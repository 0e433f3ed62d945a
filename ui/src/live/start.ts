import type { Session } from '../shell/session';
import { checklistOf, isReady, type Check } from './checklist';
import type { Live } from './store';

type Desk = Pick<Session, 'live' | 'waiting'>;

/** The checklist as things are now. */
export const checkNow = ({ live }: Pick<Session, 'live'>): Check[] =>
  checklistOf({
    broker: live.broker.get(),
    show: live.opened.get().show,
    plan: live.plan.get(),
    rows: live.fleet.get().rows,
    robots: live.track.latest(),
  });

/** Plays from the chosen frame if all is well; otherwise shows what is missing first. */
export const startPlay = (session: Session) =>
  whenPlanned(session, () => {
    if (isReady(checkNow(session)))
      void session.ask({ do: 'play', from: session.frame.get(), missing: 'refuse' });
    else session.checking.set(true);
  });

/** Does it once the plan of the show as it is now has been made: at once, or when it comes. */
export function whenPlanned({ live, waiting }: Desk, act: () => void) {
  if (isPlanned(live)) act();
  else waiting.set({ name: live.opened.get().name, act });
}

/** Does what waits for the plan when it comes; gives it up with the link or the show. Returns how to stop. */
export function followPlan({ live, waiting }: Desk): () => void {
  const look = () => {
    const wish = waiting.get();
    if (!wish) return;
    const isGivenUp = live.link.get() !== 'open' || live.opened.get().name !== wish.name;
    if (!isGivenUp && !isPlanned(live)) return;
    waiting.set(null);
    if (!isGivenUp) wish.act();
  };
  const stops = [live.plan, live.opened, live.link].map((store) => store.subscribe(look));
  return () => {
    waiting.set(null);
    stops.forEach((stop) => stop());
  };
}

function isPlanned(live: Live): boolean {
  const [plan, opened] = [live.plan.get(), live.opened.get()];
  return plan !== null && !plan.planning && plan.revision === opened.revision;
}
