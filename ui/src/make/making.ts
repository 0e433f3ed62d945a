import type { MakeAnswer, MakeQuality } from '../api/types.gen';
import type { Box } from '../base/geometry';
import { createStore, type Readable, type Store } from '../base/store';
import type { Frame, Show } from '../model/show';
import type { FrameSource } from '../model/sources';
import { sourcesOf, type Draft } from './draft';
import { planDrives, type Drives } from './drive';
import type { Maker } from './maker';
import { IDLE_PEN, type Pen } from './penState';
import { lightsBox } from './picture';
import { makePictures, type Picture, type Pictures } from './pictures';

/** A frame that is being made, or several: the settings, and the newest answer to them. */
export interface Making {
  /** Key of the frame that the pixels are made for. */
  readonly frame: number;
  readonly robots: number;
  draft: Readable<Draft>;
  /** Ids of pixels that were moved by hand and keep their places. */
  moved: Readable<readonly number[]>;
  made: Readable<Made>;
  /** The pen for a line that is drawn on the floor. */
  pen: Store<Pen>;
  /** Index of the picture on the stage, where the settings give several, counted from 0. */
  at: Store<number>;
  change(fields: Partial<Draft>): void;
  /** Forgets which pixels were moved by hand, so that they are placed anew too. */
  forgetMoved(): void;
  /** The full result for the present settings, made if need be; null: nothing to make, an error, or a newer change. */
  complete(): Promise<readonly Picture[] | null>;
  /** Ignores all answers from now on. */
  end(): void;
}

/** The answers to the settings. */
export interface Made {
  /** The newest answer without an error, shown until the next one is there; null: none yet. */
  shown: Pictures | null;
  /** The answer to the present settings; null: none yet, or there is nothing to make. */
  answer: Pictures | null;
  /** Whether `answer` is the full result, or an error. */
  isFull: boolean;
  /** The box around the lights of `shown`, along the picture's axes, in shares of its longer side; null: no lights. */
  box: Box | null;
  /** The drives to `answer`; null: they are not planned. */
  drives: Drives | null;
}

/** What is made, and for which frame of which show. */
export interface MakingOf {
  show: Show;
  frame: Frame;
  robots: number;
  draft: Draft;
  moved: readonly number[];
  /** The bytes of a file by its hash. */
  fileOf(hash: string): Promise<Uint8Array>;
}

/** Time without a change after a quick answer until the full result is made, milliseconds. */
export const REST_MS = 250;

const NOTHING: Made = { shown: null, answer: null, isFull: false, box: null, drives: null };

/** The answer with the pixels that the stage shows; null: none yet. */
export const pictureShown = (making: Making): MakeAnswer | null => {
  const pictures = making.made.get().shown?.pictures ?? [];
  return pictures[Math.min(making.at.get(), pictures.length - 1)]?.answer ?? null;
};

const answersOf = ({ pictures }: Pictures) => pictures.map((picture) => picture.answer);

export function createMaking(maker: Maker, of: MakingOf): Making {
  const draft: Store<Draft> = createStore(of.draft);
  const moved = createStore(of.moved);
  const made = createStore(NOTHING);
  const pen = createStore(IDLE_PEN);
  let version = 0;
  let timer: ReturnType<typeof setTimeout> | undefined;

  const sources = (): FrameSource[] => {
    const found = sourcesOf(draft.get());
    return found.length === 1 ? found.map((one) => ({ ...one, moved: moved.get() })) : found;
  };
  /** Makes the present settings; null: they changed meanwhile, or a newer request replaced this one. */
  const make = async (quality: MakeQuality): Promise<Pictures | null> => {
    const asked = version;
    const wish = { ...of, draft: draft.get(), sources: sources(), quality };
    const answer = await makePictures(maker, wish, () => asked === version);
    if (answer === null || asked !== version) return null;
    const shown = answer.error === null ? answer : made.get().shown;
    const box =
      answer.error === null
        ? lightsBox(answersOf(answer), draft.get(), moved.get())
        : made.get().box;
    const isFull = quality === 'full' || answer.error !== null;
    made.set({ shown, answer, box, isFull, drives: null });
    return answer;
  };
  /** Makes the full result, and then plans the drives to it. */
  const finish = async () => {
    const answer = await make('full');
    if (!answer || answer.error !== null) return;
    const asked = version;
    const drives = await planDrives(maker, of.show, of.frame, answer.pictures);
    if (asked === version) made.update((now) => ({ ...now, drives }));
  };
  const begin = () => {
    version++;
    clearTimeout(timer);
    if (sources().length === 0) {
      made.set(NOTHING);
      return;
    }
    made.update((now) => ({ ...now, answer: null, isFull: false, drives: null }));
    void make('quick').then((answer) => {
      if (answer && answer.error === null) timer = setTimeout(() => void finish(), REST_MS);
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
    at: createStore(0),
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
      if (sources().length === 0) return null;
      const { answer: known, isFull } = made.get();
      const answer = isFull ? known : await make('full');
      return answer && answer.error === null ? answer.pictures : null;
    },
    end() {
      version++;
      clearTimeout(timer);
    },
  };
}
