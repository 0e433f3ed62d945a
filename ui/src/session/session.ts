import { createContext, useContext } from 'react';
import type { Link } from '../api/socket';
import type { Answer, Choice, Operation } from '../api/types.gen';
import { createStore, type Store } from '../base/store';
import { createDrafts, type Drafts, type LeftDraft } from '../model/drafts';
import { connect, createLive, type Live } from './live';
import type { Editor } from '../model/editor';
import type { Saver } from '../model/saver';
import { tell } from './notices';

/** What every part of the page shares. */
export interface Session {
  live: Live;
  link: Link;
  /** Asks the server; what it refuses is told to the user, with its way to go on if there is one. */
  ask(operation: Operation): Promise<Answer>;
  /** A refusal that offers a way to go on. */
  offer: Store<{ reason: string; choice: Choice } | null>;
  /** The frame chosen in the strip: where Play starts, where robots are driven to. */
  frame: Store<number>;
  /** The editor of this screen; null: it has edited nothing. */
  editing: Store<{ name: string; editor: Editor; saver: Saver } | null>;
  /** What is done when the plan of the show of one of these names has been made; null: nothing waits for it. */
  waiting: Store<{ names: readonly (string | null)[]; act: () => void } | null>;
  /** Whether the checklist is shown. */
  checking: Store<boolean>;
  /** What is not on the server yet. */
  drafts: Drafts;
  /** Drafts of pages that are gone, that have not been put back. */
  orphans: Store<readonly LeftDraft[]>;
  /** The one of them that the editor shall begin anew with. */
  restoring: Store<LeftDraft | null>;
}

function shelf(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}

const randomName = () => Math.random().toString(36).slice(2);

/** What other pages left is looked for this often, milliseconds. */
const LOOK_MS = 15_000;

/** A name of this tab, the same when the page is loaded again. */
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
  const offer = createStore<{ reason: string; choice: Choice } | null>(null);
  const drafts = createDrafts(shelf(), { tab: tabName(), page: randomName(), now_ms: Date.now });
  const waiting: Session['waiting'] = createStore<ReturnType<Session['waiting']['get']>>(null);
  const orphans = createStore<readonly LeftDraft[]>(drafts.left());
  setInterval(() => orphans.set(drafts.left()), LOOK_MS);
  return {
    drafts,
    editing: createStore<ReturnType<Session['editing']['get']>>(null),
    waiting,
    checking: createStore(false),
    orphans,
    restoring: createStore<LeftDraft | null>(null),
    live,
    link,
    offer,
    frame: createStore(0),
    async ask(operation) {
      if (operation.do === 'abort' || operation.do === 'stop_all') waiting.set(null);
      const answer = await link.operate(operation);
      if (answer.ok) return answer;
      const reason = answer.error ?? 'The server refused without saying why.';
      if (answer.choice) offer.set({ reason, choice: answer.choice });
      else tell('error', reason);
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
