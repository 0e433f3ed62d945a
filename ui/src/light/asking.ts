import { listenTo, type WorkerLike } from '../base/worker';
import type { LightAsk, LightReply } from './protocol';

export type LightWorker = WorkerLike<LightAsk, LightReply>;

/** Asks a worker one thing at a time; starts the worker with the first. */
export interface Asking {
  isBusy(): boolean;
  /**
   * `done` gets the answer. Ignored while another answer is awaited, and after a failure. A failure is answered too,
   * and ends the worker for good.
   */
  ask(ask: LightAsk, done: (reply: LightReply) => void): void;
  hasFailed(): boolean;
  end(): void;
}

/** An answer that takes longer counts as a failure, milliseconds. A show of 10,000 robots takes a second or two. */
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
  return {
    isBusy: () => waiting !== null,
    hasFailed: () => failed,
    ask(ask, done) {
      if (failed || waiting) return;
      if (!worker) {
        worker = start();
        listenTo(worker, () => worker, take, { of: 'failure' });
      }
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
