/** What is needed of a worker that gets messages `Ask` and answers each with a `Reply`. */
export interface WorkerLike<Ask, Reply> {
  postMessage(ask: Ask): void;
  onmessage: ((event: MessageEvent<Reply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  terminate(): void;
}

/**
 * Listens to a worker that has just started, while it is the `current` one: a worker that was ended may have a message
 * under way, which answers nothing any more.
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
