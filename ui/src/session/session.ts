import { createContext, useContext } from 'react';
import type { Link } from '../api/socket';
import type { Answer, Choice, Operation } from '../api/types.gen';
import { createStore, type Readable, type Store } from '../base/store';
import { createDrafts, type Drafts, type LeftDraft } from '../model/drafts';
import { soundAlarms } from './alarm';
import { connect, createLive, type Live } from './live';
import { createShown, type Shown } from './shown';
import type { Editor } from '../model/editor';
import type { Saver } from '../model/saver';
import type { Dropped } from './droppable';
import type { DriveGoal } from './fleetKind';
import { notify } from './notices';
import { followRole } from './signedIn';
import type { Role } from './roles';

/** The state that all parts of the page share. */
export interface Session {
  live: Live;
  /** The show that the editor of this screen shows. */
  shown: Readable<Shown>;
  link: Link;
  /**
   * Sends an operation to the server. A refusal is shown: as `offer` if the server offers another operation, else as a
   * notice. `abort` and `stop_all` also drop the waiting action.
   */
  ask(operation: Operation): Promise<Answer>;
  /** A refusal with the operation that the server offers instead; null: none. */
  offer: Store<{ reason: string; choice: Choice } | null>;
  /** The frame chosen in the strip, counted from 0: Play starts at it, and robots are driven to it. */
  frame: Store<number>;
  /** The editor of this screen; null before the first edit. */
  editing: Store<{ name: string; editor: Editor; saver: Saver } | null>;
  /** The action that waits for the plan of a show with one of these names; null: no action waits. */
  waiting: Store<{ names: readonly (string | null)[]; act: () => void } | null>;
  /** What was dropped and waits for the editor; null: nothing waits. */
  dropped: Store<Dropped | null>;
  /** The number of robots that the open show is being fitted to; null: it is not. */
  fitting: Store<number | null>;
  /** The drive of real robots that waits for a confirmation; null: none. */
  driveAsked: Store<DriveGoal | null>;
  /** The frame that the operator wants to go to, and that waits for a confirmation; null: none. */
  jumpAsked: Store<number | null>;
  /** The robot that was searched for last, a new object with each search; null: none. */
  found: Store<{ robot: string } | null>;
  /** The role of this person; `operator` until it is known, and where sign-in is not asked for. */
  role: Readable<Role>;
  /** Whether the checklist is shown. */
  checking: Store<boolean>;
  /** Changes that are not on the server yet. */
  drafts: Drafts;
  /** Drafts of closed pages that were not restored. */
  orphans: Store<readonly LeftDraft[]>;
  /** The draft of `orphans` that the editor restores next; null: none. */
  restoring: Store<LeftDraft | null>;
}

function browserStorage(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}

const randomName = () => Math.random().toString(36).slice(2);

/** Period of the search for drafts of closed pages, milliseconds. */
const LOOK_MS = 15_000;

/** The name of this tab, which stays the same when the page is loaded again. Without storage it is new each time. */
function tabName(): string {
  const fresh = randomName();
  try {
    const name = sessionStorage.getItem('lightbots-tab') ?? fresh;
    sessionStorage.setItem('lightbots-tab', name);
    return name;
  } catch {
    return fresh;
  }
}

export function createSession(): Session {
  const live = createLive();
  const link = connect(live);
  soundAlarms(live.incidents);
  const offer = createStore<{ reason: string; choice: Choice } | null>(null);
  const drafts = createDrafts(browserStorage(), {
    tab: tabName(),
    page: randomName(),
    now_ms: Date.now,
  });
  const waiting: Session['waiting'] = createStore<ReturnType<Session['waiting']['get']>>(null);
  const orphans = createStore<readonly LeftDraft[]>(drafts.left());
  setInterval(() => orphans.set(drafts.left()), LOOK_MS);
  return {
    drafts,
    editing: createStore<ReturnType<Session['editing']['get']>>(null),
    waiting,
    dropped: createStore<Dropped | null>(null),
    fitting: createStore<number | null>(null),
    driveAsked: createStore<DriveGoal | null>(null),
    jumpAsked: createStore<number | null>(null),
    found: createStore<{ robot: string } | null>(null),
    checking: createStore(false),
    role: followRole(live.link),
    orphans,
    restoring: createStore<LeftDraft | null>(null),
    live,
    shown: createShown(live),
    link,
    offer,
    frame: createStore(0),
    async ask(operation) {
      if (operation.do === 'abort' || operation.do === 'stop_all') waiting.set(null);
      const answer = await link.operate(operation);
      if (answer.ok) return answer;
      const reason = answer.error ?? 'The server refused without saying why.';
      if (answer.choice) offer.set({ reason, choice: answer.choice });
      else if (operation.do === 'stop_all' && live.link.get() !== 'open')
        notify('error', 'STOP NOT SENT – no connection. Use the power switch.');
      else notify('error', reason);
      return answer;
    },
  };
}

export const SessionContext = createContext<Session | null>(null);

export function useSession(): Session {
  const session = useContext(SessionContext);
  if (!session) throw new Error('There is no session around this component.');
  return session;
}
