import { assetEntry, assetsOf, withAssets } from './assets';
import { number, object, without } from './jsonFields';
import type { Show } from './show';

/** The beats of the music, in seconds of its file; second 0 is the start of the first frame's air time. */
export interface Beats {
  grid: BeatGrid;
  /** Beats of a bar; the first beat begins a bar. */
  perBar: number;
}

/** Where beats are. */
export type BeatGrid =
  | { of: 'steady'; bpm: number; offset_s: number }
  /** Each beat, increasing. */
  | { of: 'times'; times_s: readonly number[] };

/** Beats of a bar where a show does not say: as in most music. */
export const PER_BAR = 4;

/** Least and greatest tempo of a show, beats a minute. */
export const BPM = { min: 10, max: 600 };

/** The beats of a show; null: the show says none, or a tempo that is not positive. */
export function beatsOf(show: Pick<Show, 'rest'>): Beats | null {
  if (show.rest.beats === undefined) return null;
  const { bpm, offset_s, times_s, per_bar } = object(show.rest.beats);
  const perBar = Math.max(1, Math.round(number(per_bar, PER_BAR)));
  if (Array.isArray(times_s))
    return { grid: { of: 'times', times_s: times_s.map((at) => number(at, 0)) }, perBar };
  const tempo = number(bpm, 0);
  if (tempo <= 0) return null;
  return { grid: { of: 'steady', bpm: tempo, offset_s: number(offset_s, 0) }, perBar };
}

/** The show with these beats; null: with none. */
export function withBeats(show: Show, beats: Beats | null): Show {
  const rest = without(show.rest, ['beats']);
  if (!beats) return { ...show, rest };
  const { grid, perBar } = beats;
  const where =
    grid.of === 'steady'
      ? { bpm: grid.bpm, offset_s: grid.offset_s }
      : { times_s: [...grid.times_s] };
  return { ...show, rest: { ...rest, beats: { ...where, per_bar: perBar } } };
}

/** A file with music. */
export interface MusicFile {
  hash: string;
  name: string;
  mediaType: string;
  bytes: number;
}

/** The file of a show's music; null: the show has none, or does not hold it. */
export function musicOf(show: Show): MusicFile | null {
  if (show.music === null) return null;
  for (const [hash, asset] of assetsOf(show))
    if (asset.name === show.music)
      return { hash, name: asset.name, mediaType: asset.media_type, bytes: asset.bytes };
  return null;
}

/** The show with this music and these beats in place of its own; null: without beats. */
export function withMusic(show: Show, file: MusicFile, beats: Beats | null): Show {
  const assets = assetEntry(file.hash, file.name, file.mediaType, file.bytes);
  return withBeats({ ...withAssets(withoutMusic(show), assets), music: file.name }, beats);
}

/** The show without music and beats. The music's file is no longer listed. */
export function withoutMusic(show: Show): Show {
  const file = musicOf(show);
  const silent = withBeats({ ...show, music: null }, null);
  if (!file) return silent;
  const assets = without(object(silent.rest.assets), [file.hash]);
  return { ...silent, rest: { ...silent.rest, assets } };
}

/** A beat, and whether it begins a bar. */
export interface Beat {
  at_s: number;
  isBar: boolean;
}

/** Beats from `from_s` to `to_s`, both included, seconds of the music file; the first `most` of them. */
export function beatsBetween(beats: Beats, from_s: number, to_s: number, most = 20_000): Beat[] {
  const { grid, perBar } = beats;
  const found: Beat[] = [];
  if (grid.of === 'times') {
    for (let i = firstFrom(grid.times_s, from_s); found.length < most; i++) {
      const at_s = grid.times_s[i];
      if (at_s === undefined || at_s > to_s) break;
      found.push({ at_s, isBar: i % perBar === 0 });
    }
    return found;
  }
  const beat_s = 60 / grid.bpm;
  let index = Math.max(0, Math.ceil((from_s - grid.offset_s) / beat_s - 1e-9));
  for (; found.length < most; index++) {
    const at_s = grid.offset_s + index * beat_s;
    if (at_s > to_s) break;
    found.push({ at_s, isBar: index % perBar === 0 });
  }
  return found;
}

/** Index of the first moment not before `from_s` in an increasing list; its length: there is none. */
function firstFrom(times_s: readonly number[], from_s: number): number {
  let [low, high] = [0, times_s.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times_s[middle] ?? 0) < from_s) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** The tempo, beats a minute: of listed beats by the median gap; 0: fewer than two beats. */
export function tempoOf({ grid }: Beats): number {
  if (grid.of === 'steady') return grid.bpm;
  const gaps = grid.times_s.slice(1).map((at, i) => at - (grid.times_s[i] ?? 0));
  const middle = gaps.sort((a, b) => a - b)[gaps.length >> 1];
  return middle ? 60 / middle : 0;
}

/** Twice as many beats: a steady tempo doubles, up to `BPM.max`; listed beats get one halfway between each two. */
export function doubled({ grid, perBar }: Beats): Beats {
  if (grid.of === 'steady')
    return { perBar, grid: { ...grid, bpm: Math.min(BPM.max, 2 * grid.bpm) } };
  const { times_s } = grid;
  const all = times_s.flatMap((at, i) => {
    const next = times_s[i + 1];
    return next === undefined ? [at] : [at, (at + next) / 2];
  });
  return { perBar, grid: { of: 'times', times_s: all } };
}

/** Every second beat: a steady tempo halves, down to `BPM.min`; of listed beats the 1st, 3rd, 5th … stay. */
export function halved({ grid, perBar }: Beats): Beats {
  if (grid.of === 'steady')
    return { perBar, grid: { ...grid, bpm: Math.max(BPM.min, grid.bpm / 2) } };
  return { perBar, grid: { of: 'times', times_s: grid.times_s.filter((_, i) => i % 2 === 0) } };
}

/**
 * All beats later by a share of a beat, or earlier if it is negative. Listed beats before second 0 of the file are left
 * out. A steady grid that would begin before it begins one beat later.
 */
export function shifted({ grid, perBar }: Beats, share: number): Beats {
  if (grid.of === 'steady') {
    const beat_s = 60 / grid.bpm;
    const offset_s = grid.offset_s + share * beat_s;
    return { perBar, grid: { ...grid, offset_s: offset_s < 0 ? offset_s + beat_s : offset_s } };
  }
  const { times_s } = grid;
  const gap = (i: number) => (times_s[i + 1] ?? NaN) - (times_s[i] ?? 0);
  const last = times_s.length - 2;
  const moved = times_s.map((at, i) => at + share * gap(Math.min(i, last)));
  return { perBar, grid: { of: 'times', times_s: moved.filter((at) => at >= 0) } };
}

/** All beats later by `by_s` seconds, or earlier if negative, as by `shifted`. */
export function nudged(beats: Beats, by_s: number): Beats {
  return shifted(beats, (by_s * tempoOf(beats)) / 60);
}

/** Bars begin one beat later: the first beat goes. */
export function barsLater({ grid, perBar }: Beats): Beats {
  if (grid.of === 'steady')
    return { perBar, grid: { ...grid, offset_s: grid.offset_s + 60 / grid.bpm } };
  return { perBar, grid: { of: 'times', times_s: grid.times_s.slice(1) } };
}

/** Least number of taps that give a tempo. */
export const TAPS_LEAST = 4;

/**
 * The steady tempo through taps (least squares), seconds of the music file; null: fewer than `TAPS_LEAST` taps, or a
 * tempo outside `BPM`. The first tap begins a bar. The grid begins as many whole bars earlier as fit into the file.
 */
export function tapped(taps_s: readonly number[], perBar: number): Beats | null {
  const count = taps_s.length;
  if (count < TAPS_LEAST) return null;
  const [middle, mean] = [(count - 1) / 2, taps_s.reduce((a, b) => a + b, 0) / count];
  let [over, under] = [0, 0];
  taps_s.forEach((at, i) => {
    over += (i - middle) * (at - mean);
    under += (i - middle) ** 2;
  });
  const beat_s = over / under;
  const bpm = 60 / beat_s;
  if (!(bpm >= BPM.min && bpm <= BPM.max)) return null;
  const first_s = mean - middle * beat_s;
  // Whole bars before the first tap, so that it begins a bar.
  const bar_s = beat_s * perBar;
  const offset_s = first_s - Math.floor((first_s + 1e-9) / bar_s) * bar_s;
  return { perBar, grid: { of: 'steady', bpm, offset_s: Math.max(0, offset_s) } };
}
