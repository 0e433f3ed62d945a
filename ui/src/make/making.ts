import type { MakeAnswer, MakeQuality } from '../api/types.gen';
import type { Box } from '../base/geometry';
import { createStore, type Readable, type Store } from '../base/store';
import type { Frame, Show } from '../model/show';
import type { FrameSource } from '../model/sources';
import { sourceOf, type Draft } from './draft';
import { requestOf } from './frame';
import type { Maker } from './maker';
import { IDLE_PEN, type Pen } from './penState';
import { lightsBox } from './picture';

/** A frame that is being made: its settings, and the newest answer to them. */
export interface Making {
  /** Key of the frame. */
  readonly frame: number;
  readonly robots: number;
  draft: Readable<Draft>;
  /** Ids of pixels that were moved by hand and keep their places. */
  moved: Readable<readonly number[]>;
  made: Readable<Made>;
  /** The pen for a line that is drawn on the floor. */
  pen: Store<Pen>;
  change(fields: Partial<Draft>): void;
  /** Places the moved pixels anew as well. */
  forgetMoved(): void;
  /** The full result for the settings as they are; null: there is none. */
  complete(): Promise<Complete | null>;
  /** Takes no more answers. */
  end(): void;
}

/** What is known about the settings. */
export interface Made {
  /** The newest answer with pixels, shown while the next one is made; null: none yet. */
  shown: MakeAnswer | null;
  /** The answer to the settings as they are; null: none yet, or there is nothing to make. */
  answer: MakeAnswer | null;
  /** Whether `answer` is the full result. */
  isFull: boolean;
  /** The box around the lights of `shown`, along the picture's axes, in shares of its longer side; null: no lights. */
  box: Box | null;
}

export interface Complete {
  source: FrameSource;
  answer: MakeAnswer;
}

/** What a making is about. */
export interface MakingOf {
  show: Show;
  frame: Frame;
  robots: number;
  draft: Draft;
  moved: readonly number[];
  /** The bytes of a file by its hash. */
  fileOf(hash: string): Promise<Uint8Array>;
}

/** Settings that rest for this long get the full result, milliseconds. */
export const REST_MS = 250;

const NOTHING: Made = { shown: null, answer: null, isFull: false, box: null };

export function createMaking(maker: Maker, of: MakingOf): Making {
  const draft: Store<Draft> = createStore(of.draft);
  const moved = createStore(of.moved);
  const made = createStore(NOTHING);
  const pen = createStore(IDLE_PEN);
  let version = 0;
  let timer: ReturnType<typeof setTimeout> | undefined;

  const source = (): FrameSource | null => {
    const found = sourceOf(draft.get());
    return found && { ...found, moved: moved.get() };
  };
  /** Makes the settings as they are; null: they changed meanwhile. */
  const make = async (wanted: FrameSource, quality: MakeQuality): Promise<MakeAnswer | null> => {
    const asked = version;
    const answer = await answerOf(wanted, quality);
    if (answer === null || asked !== version) return null;
    const shown = answer.error === null ? answer : made.get().shown;
    const box =
      answer.error === null ? lightsBox(answer, draft.get(), moved.get()) : made.get().box;
    made.set({ shown, answer, box, isFull: quality === 'full' || answer.error !== null });
    return answer;
  };
  const answerOf = async (wanted: FrameSource, quality: MakeQuality) => {
    const request = requestOf(of.show, of.frame, wanted, of.robots, quality);
    try {
      const asset = wanted.asset === null ? null : await of.fileOf(wanted.asset);
      return await maker.make(request, asset);
    } catch (error) {
      return failed(error instanceof Error ? error.message : String(error));
    }
  };
  const begin = () => {
    version++;
    clearTimeout(timer);
    const wanted = source();
    if (!wanted) {
      made.set(NOTHING);
      return;
    }
    made.update((now) => ({ ...now, answer: null, isFull: false }));
    void make(wanted, 'quick').then((answer) => {
      if (answer && answer.error === null)
        timer = setTimeout(() => void make(wanted, 'full'), REST_MS);
    });
  };
  begin();
  return {
    frame: of.frame.key,
    robots: of.robots,
    draft,
    moved,
    made,
    pen,
    change(fields) {
      draft.update((now) => ({ ...now, ...fields }));
      begin();
    },
    forgetMoved() {
      moved.set([]);
      begin();
    },
    async complete() {
      clearTimeout(timer);
      const wanted = source();
      if (!wanted) return null;
      const { answer: known, isFull } = made.get();
      const answer = isFull ? known : await make(wanted, 'full');
      return answer && answer.error === null ? { source: wanted, answer } : null;
    },
    end() {
      version++;
      clearTimeout(timer);
    },
  };
}

const failed = (message: string): MakeAnswer => ({
  pixels: [],
  size_m: 0,
  closest_m: null,
  readability: null,
  enough: null,
  notes: [],
  error: { code: 'no-answer', message },
});
