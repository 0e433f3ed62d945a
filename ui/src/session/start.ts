import type { Session } from './session';
import { checklistOf, isReady, type Check } from './checklist';
import type { Opened } from './live';
import { notify } from './notices';

type Context = Pick<Session, 'live' | 'waiting' | 'editing'>;

/** The checklist as things are now. */
export const checkNow = ({ live }: Pick<Session, 'live'>): Check[] =>
  checklistOf({
    broker: live.broker.get(),
    show: live.opened.get().show,
    plan: live.plan.get(),
    rows: live.fleet.get().rows,
    robots: live.track.latest(),
  });

/** Waits for the plan, then plays from the chosen frame if all checks pass; otherwise opens the checklist. */
export const startPlay = (session: Session) =>
  whenPlanned(session, () => {
    if (isReady(checkNow(session)))
      void session.ask({ do: 'play', from: session.frame.get(), missing: 'refuse' });
    else session.checking.set(true);
  });

/**
 * Calls `act` at once if the open show is saved and planned. Otherwise `act` waits for the plan, in place of any action
 * that waited before.
 */
export function whenPlanned(desk: Context, act: () => void) {
  if (isPlanned(desk)) act();
  else desk.waiting.set({ names: [desk.live.opened.get().name], act });
}

/**
 * Calls the waiting action when the plan arrives. Drops it when the connection is lost or another show is open. Returns
 * a function that ends this and also drops it.
 */
export function followPlan(desk: Context): () => void {
  const { live, waiting } = desk;
  const look = () => {
    const pending = waiting.get();
    if (!pending) return;
    const whyNot = whyGivenUp(live, pending.names);
    if (!whyNot && !isPlanned(desk)) return;
    waiting.set(null);
    if (whyNot)
      notify('kept', `${whyNot} before the show was planned. Nothing was begun: press again.`);
    else pending.act();
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

/** Why an action that waits for the plan of such a show is given up, as the begin of a sentence; null: it waits. */
function whyGivenUp(live: Context['live'], names: readonly (string | null)[]): string | null {
  if (live.link.get() !== 'open') return 'The connection to LightBots broke';
  return names.includes(live.opened.get().name) ? null : 'Another show was opened';
}

function isPlanned({ live, editing }: Context): boolean {
  const [plan, opened] = [live.plan.get(), live.opened.get()];
  if (isUnsaved(editing.get(), opened)) return false;
  return plan !== null && !plan.planning && plan.revision === opened.revision;
}

/** Whether this screen has edited the open show, and the server has not announced that version yet. */
function isUnsaved(
  editing: ReturnType<Session['editing']['get']>,
  { name, etag }: Pick<Opened, 'name' | 'etag'>,
): boolean {
  if (!editing || editing.name !== name) return false;
  const state = editing.saver.state.get().name;
  if (state === 'waiting' || state === 'saving') return true;
  return state === 'saved' && editing.saver.etag() !== etag;
}
