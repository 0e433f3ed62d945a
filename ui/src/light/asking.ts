import type { LightAsk, LightReply } from './protocol';

/** What asking needs of a worker. */
export interface LightWorker {
  postMessage(ask: LightAsk): void;
  onmessage: ((event: MessageEvent<LightReply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  terminate(): void;
}

/** Asks a worker one thing at a time; starts it with the first. */
export interface Asking {
  isBusy(): boolean;
  /** `done` gets the answer; a failure ends the worker, and nothing is answered any more. */
  ask(ask: LightAsk, done: (reply: LightReply) => void): void;
  hasFailed(): boolean;
  end(): void;
}

/** An answer that takes longer is given up, milliseconds: a show of ten thousand robots is read in a second or two. */
export const ANSWER_MAX_MS = 20_000;

export function createAsking(start: () => LightWorker): Asking {
  let worker: LightWorker | null = null;
  let waiting: ((reply: LightReply) => void) | null = null;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let failed = false;
  const stop = () => {
    clearTimeout(timer);
    worker?.terminate();
    worker = null;
  };
  const take = (reply: LightReply) => {
    clearTimeout(timer);
    const done = waiting;
    waiting = null;
    if (reply.of === 'failure') {
      failed = true;
      stop();
    }
    done?.(reply);
  };
  const started = (): LightWorker => {
    const mine = start();
    // A worker that was ended may have a message under way, which answers nothing any more.
    mine.onmessage = ({ data }) => worker === mine && take(data);
    mine.onerror = () => worker === mine && take({ of: 'failure' });
    return mine;
  };
  return {
    isBusy: () => waiting !== null,
    hasFailed: () => failed,
    ask(ask, done) {
      if (failed || waiting) return;
      worker ??= started();
      waiting = done;
      timer = setTimeout(() => take({ of: 'failure' }), ANSWER_MAX_MS);
      worker.postMessage(ask);
    },
    end() {
      waiting = null;
      stop();
    },
  };
}
