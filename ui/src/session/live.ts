import { leaveIfSignedOut } from './signedIn';
import { createLink, type Link, type LinkState } from '../api/socket';
import type {
  Broker,
  Fleet,
  Hello,
  Incident,
  LogLine,
  Plan,
  Playback,
  ToScreen,
} from '../api/types.gen';
import { createStore, type Store } from '../base/store';
import { readShow } from '../model/json';
import type { Show } from '../model/show';
import { createHeldMessages } from './heldMessages';
import { createShowClock, type ShowClock } from './showClock';
import { createTrack, type Track } from './track';

/** The show that is open on the server. */
export interface Opened {
  revision: number;
  name: string | null;
  etag: string | null;
  /** Why the show cannot be saved under its name: its file holds more than this version knows. null: it can. */
  readOnly: string | null;
  show: Show | null;
}

/** What the server sent last. Without a connection, the phase of `playback` is set to `idle`. */
export interface Live {
  link: Store<LinkState>;
  hello: Store<Hello | null>;
  opened: Store<Opened>;
  plan: Store<Plan | null>;
  /** The last finished plan of the open show, shown while the next one is being made; null: none yet. */
  settled: Store<Plan | null>;
  fleet: Store<Fleet>;
  broker: Store<Broker>;
  playback: Store<Playback>;
  /** Speed of the show clock; 1: real time. */
  pace: Store<number>;
  log: Store<readonly LogLine[]>;
  /** Incidents, the oldest first. */
  incidents: Store<readonly Incident[]>;
  track: Track;
  /** Where the show is on its timeline. */
  showClock: ShowClock;
}

/** Most lines of the log that the page keeps. */
const LOG_MAX = 500;

const NO_PLAYBACK: Playback = {
  phase: 'idle',
  doing: null,
  frame: null,
  next: null,
  live_light: [],
  may_jump: false,
  frames: 0,
  progress: 0,
  left_s: null,
  failure: null,
  looping: false,
  speed_percent: 100,
  first_run: false,
  stopped_in: null,
  preflight: null,
  cue: null,
  repeats: null,
  may_go_on: false,
  late: [],
};

export function createLive(): Live {
  return {
    link: createStore<LinkState>('connecting'),
    hello: createStore<Hello | null>(null),
    opened: createStore<Opened>({
      revision: -1,
      name: null,
      etag: null,
      readOnly: null,
      show: null,
    }),
    plan: createStore<Plan | null>(null),
    settled: createStore<Plan | null>(null),
    fleet: createStore<Fleet>({ revision: 0, only_listed: false, rows: [] }),
    broker: createStore<Broker>({
      address: '',
      phase: 'off',
      connected: false,
      node: null,
      reason: null,
    }),
    playback: createStore<Playback>(NO_PLAYBACK),
    pace: createStore(1),
    log: createStore<readonly LogLine[]>([]),
    incidents: createStore<readonly Incident[]>([]),
    track: createTrack(),
    showClock: createShowClock(),
  };
}

/** Stores what one message of the server says. Of a state message, `hearState` takes pace and show time. */
export function receive(live: Live, message: ToScreen) {
  switch (message.type) {
    case 'hello':
      live.hello.set(message);
      // A server that was started again counts revisions anew.
      live.plan.set(null);
      live.log.set([]);
      break;
    case 'show':
      // The plan of a show may be here before the show itself.
      if (message.name !== live.opened.get().name)
        live.settled.set(finishedPlan(live, message.revision));
      live.opened.set({
        revision: message.revision,
        name: message.name,
        etag: message.etag,
        readOnly: message.read_only,
        show: message.document === null ? null : readShow(message.document),
      });
      break;
    case 'plan':
      live.plan.set(message);
      if (!message.planning) live.settled.set(message);
      break;
    case 'fleet':
      live.fleet.set(message);
      break;
    case 'log':
      live.log.update((lines) => withLine(lines, message));
      break;
    case 'incidents':
      live.incidents.set(message.list);
      break;
    case 'state':
      keep(live.broker, message.broker);
      keep(live.playback, message.playback);
      break;
    case 'answer':
      break;
  }
}

function finishedPlan({ plan }: Live, revision: number): Plan | null {
  const here = plan.get();
  return here?.revision === revision && !here.planning ? here : null;
}

/** Takes pace and show time from a state message, also while the page is hidden. */
function hearState({ pace, showClock }: Live, state: Extract<ToScreen, { type: 'state' }>) {
  pace.set(state.pace);
  showClock.hear(state.at_ms, state.show_time, performance.now());
}

/** The log with the line in place of the line with its id, else at the end. Above `LOG_MAX`, the oldest line goes. */
function withLine(lines: readonly LogLine[], line: LogLine): readonly LogLine[] {
  const before = lines.findLastIndex(({ id }) => id === line.id);
  return before >= 0 ? lines.with(before, line) : [...lines.slice(-LOG_MAX + 1), line];
}

/** Sets a value unless its JSON equals that of the value before. */
function keep<T>(store: Store<T>, next: T) {
  if (JSON.stringify(store.get()) !== JSON.stringify(next)) store.set(next);
}

/** The one connection of this page to its server. */
export function connect(live: Live): Link {
  const address = `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/ws`;
  const held = createHeldMessages(() => document.hidden);
  const link = createLink({
    open: () => new WebSocket(address) as never,
    isHidden: () => document.hidden,
    onMessage(message) {
      // Music goes on in a hidden page.
      if (message.type === 'state') hearState(live, message);
      if (!held.hold(message, performance.now())) receive(live, message);
    },
    onRobots: (robots) => live.track.push(robots, performance.now()),
    onLink: (state) => {
      live.link.set(state);
      // What was held is older than what comes after.
      if (state !== 'open') held.release();
      if (state === 'lost') void leaveIfSignedOut();
      if (state !== 'open') live.playback.update((p) => ({ ...p, phase: 'idle' }));
    },
  });
  document.addEventListener('visibilitychange', () => {
    if (document.hidden) return;
    held.release().forEach((message) => receive(live, message));
    link.wake();
  });
  return link;
}
