import type { Session } from './session';
import { checklistOf, isReady, type Check } from './checklist';
import type { Opened } from './live';

type Desk = Pick<Session, 'live' | 'waiting' | 'editing'>;

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

/** Does it once the show as it is on this screen is saved and planned: at once, or when that has come about. */
export function whenPlanned(desk: Desk, act: () => void) {
  if (isPlanned(desk)) act();
  else desk.waiting.set({ names: [desk.live.opened.get().name], act });
}

/** Does what waits for the plan when it comes; gives it up with the link or the show. Returns how to stop. */
export function followPlan(desk: Desk): () => void {
  const { live, waiting } = desk;
  const look = () => {
    const wish = waiting.get();
    if (!wish) return;
    const isGivenUp = live.link.get() !== 'open' || !wish.names.includes(live.opened.get().name);
    if (!isGivenUp && !isPlanned(desk)) return;
    waiting.set(null);
    if (!isGivenUp) wish.act();
  };
  const stops = [live.plan, live.opened, live.link].map((store) => store.subscribe(look));
  const saver = desk.editing.get()?.saver;
  if (saver) stops.push(saver.state.subscribe(look));
  look();
  return () => {
    waiting.set(null);
    stops.forEach((stop) => stop());
  };
}

function isPlanned({ live, editing }: Desk): boolean {
  const [plan, opened] = [live.plan.get(), live.opened.get()];
  if (isUnsaved(editing.get(), opened)) return false;
  return plan !== null && !plan.planning && plan.revision === opened.revision;
}

/** Whether this screen has edited the open show, and the server has not told everybody yet. */
function isUnsaved(
  editing: ReturnType<Session['editing']['get']>,
  { name, etag }: Pick<Opened, 'name' | 'etag'>,
): boolean {
  if (!editing || editing.name !== name) return false;
  const state = editing.saver.state.get().name;
  if (state === 'waiting' || state === 'saving') return true;
  return state === 'saved' && editing.saver.etag() !== etag;
}
