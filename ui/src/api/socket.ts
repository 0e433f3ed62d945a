import { backoff_ms } from './backoff';
import { readRobots } from './robots';
import type { Answer, FromScreen, Operation, Robots, ToScreen } from './types.gen';

/** What of a WebSocket is used, so that tests can stand in for it. */
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
  /** Asks the server; resolves with its answer, or with a refusal in words when there is no link. Never rejects. */
  operate(operation: Operation): Promise<Answer>;
  /** Tries again at once instead of waiting. */
  retry(): void;
  /** The page is seen again, and wants to know everything at once. */
  wake(): void;
  close(): void;
}

export interface LinkOptions {
  open(): SocketLike;
  onMessage(message: ToScreen): void;
  /** Where robots are; comes before the `state` it belongs to. */
  onRobots(robots: Robots): void;
  onLink(state: LinkState): void;
  /** Whether the page cannot be seen: then it takes a few states a second, and leaves the machine to pages that are seen. */
  isHidden?(): boolean;
  random?(): number;
}

/** No answer after this long counts as refused, milliseconds. */
const ANSWER_MAX_MS = 10_000;

/** A hidden page acknowledges states this often, milliseconds. */
const HIDDEN_MS = 1_000;

/** A WebSocket that comes back by itself. */
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

  /** Acknowledgements that a hidden page holds back. */
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
