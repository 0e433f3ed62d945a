import { backoff_ms } from './backoff';
import { readRobots } from './robots';
import type { Answer, FromScreen, Operation, Robots, ToScreen } from './types.gen';

/** The part of a WebSocket that is used, so that tests can replace it. */
export interface SocketLike {
  binaryType: string;
  send(text: string): void;
  close(): void;
  onopen: (() => void) | null;
  onclose: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
}

export type LinkState = 'connecting' | 'open' | 'lost';

export interface Link {
  /** Asks the server; resolves with its answer, or with a refusal without a connection or an answer. Never rejects. */
  operate(operation: Operation): Promise<Answer>;
  /** Connects at once if the link waits for its next try. */
  retry(): void;
  /** The page is seen again: sends the acknowledgements that were held back, so that the server sends on. */
  wake(): void;
  close(): void;
}

export interface LinkOptions {
  open(): SocketLike;
  onMessage(message: ToScreen): void;
  /** Called with each binary message: where robots are. */
  onRobots(robots: Robots): void;
  onLink(state: LinkState): void;
  /** Whether the page cannot be seen: then states are acknowledged late, so that the server sends it fewer. */
  isHidden?(): boolean;
  random?(): number;
}

/** An operation without an answer after this time counts as refused, milliseconds. */
const ANSWER_MAX_MS = 10_000;

/** Time that a hidden page holds back acknowledgements of states, milliseconds. */
const HIDDEN_MS = 1_000;

/** A connection to the server that is made again by itself whenever it breaks, until `close`. */
export function createLink(options: LinkOptions): Link {
  const random = options.random ?? Math.random;
  const waiting = new Map<number, (answer: Answer) => void>();
  let socket: SocketLike | null = null;
  let [up, closed, tries, lastId] = [false, false, 0, 0];
  let timer: ReturnType<typeof setTimeout> | undefined;

  const refuse = (id: number, error: string) => {
    waiting.get(id)?.({ id, ok: false, error, choice: null });
    waiting.delete(id);
  };

  /** Number of acknowledgements that are held back, and the timer that sends them. */
  let [held, release]: [number, typeof timer] = [0, undefined];
  const dropHeld = () => {
    clearTimeout(release);
    [held, release] = [0, undefined];
  };
  const sendHeld = () => {
    const count = held;
    dropHeld();
    for (let i = 0; i < count; i++) send({ type: 'took' });
  };
  const acknowledge = () => {
    held++;
    if (options.isHidden?.()) release ??= setTimeout(sendHeld, HIDDEN_MS);
    else sendHeld();
  };

  const lost = () => {
    dropHeld();
    up = false;
    socket = null;
    for (const id of [...waiting.keys()])
      refuse(id, 'The connection to the server broke. Try again.');
    if (closed) return;
    options.onLink('lost');
    timer = setTimeout(connect, backoff_ms(tries++, random()));
  };

  const send = (message: FromScreen) => socket?.send(JSON.stringify(message));

  const receive = (data: unknown) => {
    if (data instanceof ArrayBuffer) {
      const robots = readRobots(data);
      if (robots) options.onRobots(robots);
      return;
    }
    const message = decode(data);
    if (message?.type === 'answer') {
      waiting.get(message.id)?.(message);
      waiting.delete(message.id);
    } else if (message) options.onMessage(message);
    if (message?.type === 'state') acknowledge();
  };

  function connect() {
    clearTimeout(timer);
    const mine = options.open();
    mine.binaryType = 'arraybuffer';
    socket = mine;
    mine.onopen = () => {
      if (socket !== mine) return;
      up = true;
      tries = 0;
      options.onLink('open');
    };
    mine.onclose = () => {
      if (socket === mine) lost();
    };
    mine.onmessage = (event) => {
      if (socket === mine) receive(event.data);
    };
  }

  options.onLink('connecting');
  connect();
  return {
    operate(operation) {
      const id = ++lastId;
      return new Promise((resolve) => {
        waiting.set(id, resolve);
        if (!up || !socket) return refuse(id, 'There is no connection to the server right now.');
        send({ type: 'operate', id, operation });
        setTimeout(() => refuse(id, 'The server did not answer.'), ANSWER_MAX_MS);
      });
    },
    retry() {
      if (!up && !closed && socket === null) connect();
    },
    wake: sendHeld,
    close() {
      closed = true;
      dropHeld();
      clearTimeout(timer);
      socket?.close();
    },
  };
}

function decode(data: unknown): ToScreen | null {
  if (typeof data !== 'string') return null;
  try {
    const value = JSON.parse(data) as ToScreen;
    return typeof value === 'object' && typeof value.type === 'string' ? value : null;
  } catch {
    return null;
  }
}
