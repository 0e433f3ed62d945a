import type { Transition } from '../api/types.gen';
import type { Readable } from '../base/store';
import { writeShow } from '../model/json';
import { layersOf, type Layer } from '../model/layers';
import type { Show, Stage } from '../model/show';
import { createAsking, type LightWorker } from './asking';
import { createLayerPictures, type FileOf, type PictureFile } from './pictures';
import type { LightAsk, LightReply } from './protocol';
import { stripRequest, STRIP_MOMENTS, type Strip } from './strip';

/** Red, green and blue of each robot, in the order of the plan. */
export type Colours = Uint8Array;

/** Colours of a show's robots with its layers of light, computed in a worker. */
export interface Lights {
  /**
   * The colours at a moment, seconds from the start of the drive to the first frame. Unknown ones are asked for, and
   * the last known colours are the answer. Null: none are known yet, the show has no layers, or the worker failed.
   */
  at(show: Show, transitions: readonly Transition[], time_s: number): Colours | null;
  /** Colours of a layer alone on a floor full of robots; null: the worker failed, or too many were asked for since. */
  strip(layer: Layer, stage: Stage): Promise<Strip | null>;
  /** Why pictures of layers cannot be shown, by the hash of the file. */
  pictureErrors: Readable<ReadonlyMap<string, string>>;
  end(): void;
}

/** Least time between two computed moments, seconds: colours may be this late. Large fleets get longer steps. */
const STEP_S = 0.025;
/** Most colours that are computed for a second of the show, a robot at a moment being one; more makes slow requests. */
const COLOURS_PER_S = 250_000;
/** Most colours in an answer, times the number of layers, but at least one moment: the next request waits for it. */
const COLOURS_MAX = 60_000;
/** Most answers with colours that are kept; above that the oldest goes. */
const CHUNKS_MAX = 64;
/** Least time between two loads of a show, milliseconds, if more than its layers changed: a drag changes it often. */
const LOAD_EVERY_MS = 200;
/** Most strips that wait; above that the oldest is answered with null. */
const STRIPS_MAX = 40;
/** Most strips that are remembered; further ones are computed each time. */
const KNOWN_MAX = 200;

interface Loaded extends Planned {
  robots: number;
  step_s: number;
  count: number;
}

interface StripJob {
  key: string;
  layer: Layer;
  stage: Stage;
  done: (strip: Strip | null) => void;
}

export function createLights(start: () => LightWorker, fileOf: FileOf): Lights {
  const asking = createAsking(start);
  const pictures = createLayerPictures(fileOf, () => pump());
  let wantedLayers: readonly Layer[] = [];
  /** Whether a picture came after the layers were read. */
  let isStale = false;
  let loaded: Loaded | null = null;
  let wanted: (Planned & { time_s: number }) | null = null;
  let chunks = new Map<number, readonly Colours[]>();
  let last: Colours | null = null;
  let strips: StripJob[] = [];
  const known = new Map<string, Strip>();
  let readAt_ms = -Infinity;
  let timer: ReturnType<typeof setTimeout> | undefined;

  /** Asks for what is needed most: a picture, the show, colours of the moment, of the moments after it, a strip. */
  const pump = () => {
    if (asking.isBusy() || asking.hasFailed()) return;
    const picture = pictures.next();
    if (picture) return decode(picture);
    if (wanted && (isStale || !isLoaded(loaded, wanted))) {
      const early_ms = readAt_ms + LOAD_EVERY_MS - performance.now();
      if (early_ms <= 0 || onlyLayersDiffer(loaded, wanted))
        return load(wanted.show, wanted.transitions);
      timer ??= setTimeout(() => {
        timer = undefined;
        pump();
      }, early_ms);
    } else if (wanted && loaded && loaded.robots > 0) {
      const at = chunkOf(loaded, wanted.time_s);
      const missing = [at, at + 1].find((chunk) => !chunks.has(chunk));
      if (missing !== undefined) return fetchChunk(loaded, missing);
    }
    const job = strips.find(({ layer }) => !pictures.isWaiting(layer));
    if (!job) return;
    strips = strips.filter((one) => one !== job);
    makeStrip(job);
  };
  const decode = ({ hash, bytes }: PictureFile) =>
    asking.ask({ do: 'picture', hash, bytes }, (reply) => {
      if (reply.of === 'loaded') pictures.decoded(hash, reply.answer.error?.message ?? null);
      isStale = true;
      next(reply);
    });
  const load = (show: Show, transitions: readonly Transition[]) => {
    const isSame = onlyLayersDiffer(loaded, { show, transitions });
    if (!isSame) readAt_ms = performance.now();
    isStale = false;
    const request: LightAsk = isSame
      ? { do: 'relight', document: layersAlone(show) }
      : { do: 'load', request: { show: writeShow(show), transitions: [...transitions] } };
    asking.ask(request, (reply) => {
      chunks = new Map();
      const robots = reply.of === 'loaded' && !reply.answer.error ? reply.answer.robots : 0;
      loaded = { show, transitions, robots, ...paceOf(robots, layersOf(show).length) };
      next(reply);
    });
  };
  const fetchChunk = (from: Loaded, chunk: number) => {
    const { step_s, count, robots } = from;
    const moments = { from_s: chunk * count * step_s, step_s, count };
    asking.ask({ do: 'colours', moments }, (reply) => {
      if (reply.of === 'colours') {
        const row = 3 * robots;
        const rows = Array.from({ length: Math.floor(reply.bytes.length / row) }, (_, nth) =>
          reply.bytes.subarray(nth * row, (nth + 1) * row),
        );
        chunks.set(chunk, rows);
        const oldest = chunks.size > CHUNKS_MAX ? chunks.keys().next() : null;
        if (oldest && !oldest.done) chunks.delete(oldest.value);
      }
      next(reply);
    });
  };
  const makeStrip = (job: StripJob) => {
    const request = stripRequest(job.layer, job.stage);
    asking.ask({ do: 'strip', request, moments: STRIP_MOMENTS }, (reply) => {
      const strip = reply.of === 'colours' ? reply.bytes : null;
      if (strip && known.size < KNOWN_MAX) known.set(job.key, strip);
      job.done(strip);
      next(reply);
    });
  };
  const next = (reply: LightReply) => {
    if (reply.of !== 'failure') return pump();
    strips.forEach((job) => job.done(null));
    strips = [];
  };
  return {
    pictureErrors: pictures.errors,
    at(show, transitions, time_s) {
      if (layersOf(show).length === 0 || asking.hasFailed()) {
        wanted = last = null;
        return null;
      }
      wanted = { show, transitions, time_s };
      if (wantedLayers !== layersOf(show)) pictures.want((wantedLayers = layersOf(show)));
      pump();
      if (loaded && isLoaded(loaded, wanted)) {
        const { step_s, count } = loaded;
        const chunk = chunkOf(loaded, time_s);
        const rows = chunks.get(chunk);
        const nth = Math.floor(time_s / step_s + NEARLY) - chunk * count;
        last = rows?.[Math.min(nth, rows.length - 1)] ?? last;
      }
      return last;
    },
    strip(layer, stage) {
      const key = JSON.stringify([layer.kind, layer.settings, stage.width_m, stage.depth_m]);
      const found = known.get(key);
      if (found) return Promise.resolve(found);
      return new Promise((done) => {
        if (asking.hasFailed()) return done(null);
        pictures.want([layer]);
        strips.push({ key, layer, stage, done });
        if (strips.length > STRIPS_MAX) strips.shift()?.done(null);
        pump();
      });
    },
    end() {
      clearTimeout(timer);
      asking.end();
      strips.forEach((job) => job.done(null));
      strips = [];
    },
  };
}

/** A moment less than this share of a step before the next step belongs to that one, because of rounding errors. */
const NEARLY = 1e-6;

const chunkOf = ({ step_s, count }: Loaded, time_s: number) =>
  Math.floor(Math.floor(Math.max(0, time_s) / step_s + NEARLY) / count);

/** Number of moments in an answer and the time between two, for a number of robots and layers. */
function paceOf(robots: number, layers: number): { step_s: number; count: number } {
  const step_s = Math.max(STEP_S, robots / COLOURS_PER_S);
  const each = Math.max(1, robots) * Math.max(1, layers);
  const second = Math.round(1 / step_s);
  return { step_s, count: Math.max(1, Math.min(second, Math.floor(COLOURS_MAX / each))) };
}

interface Planned {
  show: Show;
  transitions: readonly Transition[];
}

const onlyLayersDiffer = (loaded: Loaded | null, wanted: Planned) =>
  loaded !== null &&
  loaded.transitions === wanted.transitions &&
  loaded.show.frames === wanted.show.frames &&
  loaded.show.stage === wanted.show.stage;

const isLoaded = (loaded: Loaded | null, wanted: Planned) =>
  onlyLayersDiffer(loaded, wanted) && loaded && layersOf(loaded.show) === layersOf(wanted.show);

/** The show as a document without pixels and sources, for its layers. */
const layersAlone = (show: Show): unknown =>
  writeShow({
    ...show,
    frames: show.frames.map((frame) => ({ ...frame, pixels: [], sources: [] })),
  });
