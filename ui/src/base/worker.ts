/** What is needed of a worker that gets messages `Ask` and answers each with a `Reply`. */
export interface WorkerLike<Ask, Reply> {
  postMessage(ask: Ask): void;
  onmessage: ((event: MessageEvent<Reply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  terminate(): void;
}

/**
 * Passes a worker's messages to `take`, and `broken` for an error. Ignores both once the worker is not the `current`
 * one: a message may still be under way when it is ended.
 */
export function listenTo<Ask, Reply>(
  worker: WorkerLike<Ask, Reply>,
  current: () => WorkerLike<Ask, Reply> | null,
  take: (reply: Reply) => void,
  broken: Reply,
) {
  worker.onmessage = ({ data }) => current() === worker && take(data);
  worker.onerror = () => current() === worker && take(broken);
}
