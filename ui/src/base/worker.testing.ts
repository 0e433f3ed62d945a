import type { WorkerLike } from './worker';

/** A worker on this thread: `answer` answers each message, after the present code has run. */
export function answering<Ask, Reply>(answer: (ask: Ask) => Reply): WorkerLike<Ask, Reply> {
  const worker: WorkerLike<Ask, Reply> = {
    onmessage: null,
    onerror: null,
    postMessage: (ask) =>
      void Promise.resolve().then(() =>
        worker.onmessage?.({ data: answer(ask) } as MessageEvent<Reply>),
      ),
    terminate: () => undefined,
  };
  return worker;
}
