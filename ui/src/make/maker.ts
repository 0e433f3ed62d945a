import type {
  BeatsAnswer,
  FilmAnswer,
  FitAnswer,
  MakeAnswer,
  MakeChoices,
  MakeFile,
  MakeRequest,
  MovedAnswer,
  PlanAnswer,
  PlanningRequest,
} from '../api/types.gen';
import { listenTo, type WorkerLike } from '../base/worker';
import type { Ask, Cause, Reply } from './protocol';

export type MakeWorker = WorkerLike<Ask, Reply>;

/** Makes frames, plans and more in a worker that is started with the first request. */
export interface Maker {
  /**
   * Makes a frame. Requests of `make`, `film` and `plan` replace each other: only the newest waits, and one that a
   * newer one replaced is answered with null.
   */
  make(request: MakeRequest, asset: Uint8Array | null): Promise<MakeAnswer | null>;
  /** Makes the frames of an animation, as `make` does one frame. */
  film(request: MakeRequest, bytes: Uint8Array): Promise<FilmAnswer | null>;
  /** Fits a show, the bytes of a file, to another number of robots. */
  fit(show: Uint8Array, robots: number): Promise<FitAnswer>;
  /** Plans a show; `null` as for `make`. */
  plan(request: PlanningRequest): Promise<PlanAnswer | null>;
  /** Where pixels are after a motion: a show of two frames, the bytes of a file. The second has the motion. */
  moved(show: Uint8Array): Promise<MovedAnswer>;
  /** Fonts and shapes that settings may name. */
  list(): Promise<MakeChoices>;
  /** What a file is. */
  look(bytes: Uint8Array): Promise<MakeFile>;
  /** Beats of music: one channel, and its samples a second. */
  beats(samples: Float32Array, rate_Hz: number): Promise<BeatsAnswer>;
  /** Ends the worker and all requests; the next request starts another worker. */
  end(): void;
}

/** Any request, but for those of `LONG`, that takes longer is given up, milliseconds. */
export const MAKE_MAX_MS = 10_000;

/** A request of `LONG` that takes longer is given up, milliseconds. */
export const MAKE_ALL_MAX_MS = 60_000;

/** Requests with a whole animation, show or piece of music, which may take `MAKE_ALL_MAX_MS`. */
const LONG: readonly Ask['do'][] = ['film', 'fit', 'beats'];

/** After a newer request, the running one may go on for this long, milliseconds: a new worker starts as slowly. */
export const GRACE_MS = 300;

interface Job {
  ask: Ask;
  done(reply: Reply | null): void;
}

/** What people read about each cause of a failure. */
const WORDS: Record<Cause, string> = {
  unloaded:
    'The part of the page that makes frames did not load. Reload the page, or use a newer browser.',
  broken: 'This cannot be made. Undo the last change of its settings, or use another file.',
  'too-slow': 'This takes too long. Use a simpler drawing, a shorter animation or fewer robots.',
};

export function createMaker(start: () => MakeWorker): Maker {
  let worker: MakeWorker | null = null;
  let running: Job | null = null;
  let queue: Job[] = [];
  let timer: ReturnType<typeof setTimeout> | undefined;

  const end = () => {
    clearTimeout(timer);
    worker?.terminate();
    worker = null;
  };
  const finish = (reply: Reply | null) => {
    clearTimeout(timer);
    const job = running;
    running = null;
    if (reply === null || reply.of === 'failure') end();
    job?.done(reply);
    next();
  };
  const giveUpIn = (ms: number, reply: Reply | null) => {
    clearTimeout(timer);
    timer = setTimeout(() => finish(reply), ms);
  };
  const fail = (cause: Cause): Reply => ({ of: 'failure', cause });
  const next = () => {
    running = queue.shift() ?? null;
    if (!running) return;
    if (!worker) {
      worker = start();
      listenTo(worker, () => worker, finish, fail('broken'));
    }
    const isLong = LONG.includes(running.ask.do);
    giveUpIn(isLong ? MAKE_ALL_MAX_MS : MAKE_MAX_MS, fail('too-slow'));
    worker.postMessage(running.ask);
  };
  const add = (ask: Ask) =>
    new Promise<Reply | null>((done) => {
      if (isPreview(ask)) {
        queue.filter((job) => isPreview(job.ask)).forEach((job) => job.done(null));
        queue = queue.filter((job) => !isPreview(job.ask));
        if (running && isPreview(running.ask)) giveUpIn(GRACE_MS, null);
      }
      queue.push({ ask, done });
      if (!running) next();
    });
  const wanted = async <T extends Reply['of']>(ask: Ask, of: T) => {
    const got = await add(ask);
    if (got?.of === of) return got as Extract<Reply, { of: T }>;
    throw new Error(WORDS[causeOf(got)]);
  };
  return {
    async make(request, asset) {
      const got = await add({ do: 'make', request, asset });
      if (got === null) return null;
      return got.of === 'make' ? got.answer : withoutPixels(causeOf(got));
    },
    async film(request, bytes) {
      const got = await add({ do: 'film', request, bytes });
      if (got === null) return null;
      if (got.of === 'film') return got.answer;
      const code = causeOf(got);
      return { frames: [], slowdown: 1, notes: [], error: { code, message: WORDS[code] } };
    },
    fit: async (show, robots) => (await wanted({ do: 'fit', show, robots }, 'fit')).answer,
    async plan(request) {
      const got = await add({ do: 'plan', request });
      if (got === null) return null;
      if (got.of === 'plan') return got.answer;
      const code = causeOf(got);
      return { plan: null, error: { code, message: WORDS[code] } };
    },
    moved: async (show) => (await wanted({ do: 'moved', show }, 'moved')).answer,
    list: async () => (await wanted({ do: 'list' }, 'list')).choices,
    look: async (bytes) => (await wanted({ do: 'look', bytes }, 'look')).file,
    beats: async (samples, rate_Hz) =>
      (await wanted({ do: 'beats', samples, rate_Hz }, 'beats')).answer,
    end() {
      queue.splice(0).forEach((job) => job.done(null));
      const job = running;
      running = null;
      end();
      job?.done(null);
    },
  };
}

/** Whether a newer request of these kinds replaces this one. */
const isPreview = (ask: Ask) => ask.do === 'make' || ask.do === 'film' || ask.do === 'plan';

const causeOf = (got: Reply | null): Cause => (got?.of === 'failure' ? got.cause : 'broken');

const withoutPixels = (code: Cause): MakeAnswer => ({
  pixels: [],
  size_m: 0,
  closest_m: null,
  readability: null,
  enough: null,
  notes: [],
  error: { code, message: WORDS[code] },
});
