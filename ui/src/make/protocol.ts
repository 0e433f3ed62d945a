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

/** A message to the worker; it answers each in order. */
export type Ask =
  | { do: 'make'; request: MakeRequest; asset: Uint8Array | null }
  /** The frames of an animation. */
  | { do: 'film'; request: MakeRequest; bytes: Uint8Array }
  /** Fits a show, given as the bytes of a file, to another number of robots. */
  | { do: 'fit'; show: Uint8Array; robots: number }
  /** A plan of a show. */
  | { do: 'plan'; request: PlanningRequest }
  /** Where pixels are after a motion: a show of two frames, the bytes of a file. */
  | { do: 'moved'; show: Uint8Array }
  | { do: 'list' }
  | { do: 'look'; bytes: Uint8Array }
  /** Beats of music: one channel, and its samples a second. */
  | { do: 'beats'; samples: Float32Array; rate_Hz: number };

/** A message from the worker. */
export type Reply =
  | { of: 'make'; answer: MakeAnswer }
  | { of: 'film'; answer: FilmAnswer }
  | { of: 'fit'; answer: FitAnswer }
  | { of: 'plan'; answer: PlanAnswer }
  | { of: 'moved'; answer: MovedAnswer }
  | { of: 'list'; choices: MakeChoices }
  | { of: 'look'; file: MakeFile }
  | { of: 'beats'; answer: BeatsAnswer }
  /** The request could not be answered; the asking side then ends the worker. */
  | { of: 'failure'; cause: Cause };

/** Why there is no answer: the module did not load, it failed at this request, or it took too long. */
export type Cause = 'unloaded' | 'broken' | 'too-slow';

/** The functions of the module, as `wasm-bindgen` writes them. */
export interface Module {
  make(request: string, asset: Uint8Array): string;
  film(request: string, bytes: Uint8Array): string;
  fit(show: Uint8Array, robots: number): string;
  plan(request: string): string;
  moved(show: Uint8Array): string;
  list(): string;
  look(bytes: Uint8Array): string;
  beats(samples: Float32Array, rate_Hz: number): string;
}

const NO_FILE = new Uint8Array();

/** The module's answer to a message. */
export function reply(module: Module, ask: Ask): Reply {
  switch (ask.do) {
    case 'make': {
      const text = module.make(JSON.stringify(ask.request), ask.asset ?? NO_FILE);
      return { of: 'make', answer: JSON.parse(text) as MakeAnswer };
    }
    case 'film': {
      const text = module.film(JSON.stringify(ask.request), ask.bytes);
      return { of: 'film', answer: JSON.parse(text) as FilmAnswer };
    }
    case 'fit':
      return { of: 'fit', answer: JSON.parse(module.fit(ask.show, ask.robots)) as FitAnswer };
    case 'plan':
      return {
        of: 'plan',
        answer: JSON.parse(module.plan(JSON.stringify(ask.request))) as PlanAnswer,
      };
    case 'moved':
      return { of: 'moved', answer: JSON.parse(module.moved(ask.show)) as MovedAnswer };
    case 'list':
      return { of: 'list', choices: JSON.parse(module.list()) as MakeChoices };
    case 'look':
      return { of: 'look', file: JSON.parse(module.look(ask.bytes)) as MakeFile };
    case 'beats': {
      const text = module.beats(ask.samples, ask.rate_Hz);
      return { of: 'beats', answer: JSON.parse(text) as BeatsAnswer };
    }
  }
}
