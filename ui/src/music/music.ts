import { messageOf } from '../base/errors';
import { createStore, type Readable } from '../base/store';
import { musicOf } from '../model/beats';
import type { Show } from '../model/show';
import { peaksOf, type DecodedMusic } from './decode';

/** A piece of music as a waveform shows it. */
export interface SeenMusic {
  hash: string;
  lasts_s: number;
  /** Loudness over time, `PEAKS_PER_S` a second, 0 to 1. */
  peaks: Float32Array;
}

/** State of the edited show's music; `none`: the show has no music, or not its file. */
export type MusicState =
  | { of: 'none' }
  | { of: 'loading' }
  | { of: 'ready'; music: SeenMusic }
  | { of: 'failed'; why: string };

export interface Music {
  state: Readable<MusicState>;
  /** Loads the music of this show, if its file is another one than before. */
  follow(show: Show): void;
  /** Decodes the show's music once more: decoded music takes much memory and is not kept. Rejects without music. */
  decode(): Promise<DecodedMusic>;
  /** Takes music that is decoded already, so that `follow` need not load it. */
  add(hash: string, decoded: DecodedMusic): void;
}

/** `fileOf` gives a file by its hash; `decode` decodes it. */
export function createMusic(
  fileOf: (hash: string) => Promise<Uint8Array<ArrayBuffer>>,
  decode: (bytes: Uint8Array<ArrayBuffer>) => Promise<DecodedMusic>,
): Music {
  const state = createStore<MusicState>({ of: 'none' });
  let wanted: string | null = null;
  /** The last decoded music: undo may bring it back. */
  let kept: SeenMusic | null = null;
  const load = async (hash: string) => {
    state.set({ of: 'loading' });
    try {
      const decoded = await decode(await fileOf(hash));
      if (wanted === hash) keep(hash, decoded);
    } catch (error) {
      if (wanted !== hash) return;
      state.set({ of: 'failed', why: messageOf(error) });
    }
  };
  const keep = (hash: string, decoded: DecodedMusic) => {
    const lasts_s = decoded.samples.length / decoded.rate_Hz;
    kept = { hash, lasts_s, peaks: peaksOf(decoded) };
    if (wanted === hash) state.set({ of: 'ready', music: kept });
  };
  return {
    state,
    follow(show) {
      const hash = musicOf(show)?.hash ?? null;
      if (hash === wanted) return;
      wanted = hash;
      if (hash === null) state.set({ of: 'none' });
      else if (kept?.hash === hash) state.set({ of: 'ready', music: kept });
      else void load(hash);
    },
    async decode() {
      if (wanted === null) throw new Error('The show has no music. Add some first.');
      return decode(await fileOf(wanted));
    },
    add: keep,
  };
}
