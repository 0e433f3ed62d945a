import { messageOf } from '../base/errors';
import type { MakeAnswer, MakeQuality, MakeRemark } from '../api/types.gen';
import type { Frame, Show } from '../model/show';
import type { FrameSource } from '../model/sources';
import { isFilm, stem, type Draft } from './draft';
import { requestOf } from './frame';
import type { Maker } from './maker';

/** What settings give: the pictures of one frame or of several, or why there are none. */
export interface Pictures {
  /** At least one, unless there is an error. */
  pictures: readonly Picture[];
  /** Factor by which an animation is slowed down; 1: as it is, or there is none. */
  slowdown: number;
  /** Remarks about the whole; each picture's answer has notes of its own. */
  notes: readonly MakeRemark[];
  error: MakeRemark | null;
}

/** What is made for one frame. */
export interface Picture {
  source: FrameSource;
  /** Name of the frame; null: it keeps its own. */
  name: string | null;
  /** Air time of the frame, seconds; null: the frame keeps its own. */
  airTime_s: number | null;
  answer: MakeAnswer;
}

/** Longer side of the largest picture, metres; null: there is none. */
export const sizeOf = (made: Pictures | null): number | null =>
  made === null || made.pictures.length === 0
    ? null
    : Math.max(...made.pictures.map((picture) => picture.answer.size_m));

/** A request for pictures. */
export interface Wish {
  show: Show;
  frame: Frame;
  robots: number;
  draft: Draft;
  /** One for each frame, at least one. */
  sources: readonly FrameSource[];
  quality: MakeQuality;
  /** The bytes of a file by its hash. */
  fileOf(hash: string): Promise<Uint8Array>;
}

/** Makes all pictures; null: a newer request replaced this one, or `isWanted` says no. An error is in the answer. */
export async function makePictures(
  maker: Maker,
  wish: Wish,
  isWanted: () => boolean,
): Promise<Pictures | null> {
  try {
    return await (isFilm(wish.draft) ? film(maker, wish) : oneByOne(maker, wish, isWanted));
  } catch (error) {
    const message = messageOf(error);
    return failed({ code: 'no-answer', message });
  }
}

const failed = (error: MakeRemark): Pictures => ({ pictures: [], slowdown: 1, notes: [], error });

async function oneByOne(
  maker: Maker,
  wish: Wish,
  isWanted: () => boolean,
): Promise<Pictures | null> {
  const pictures: Picture[] = [];
  for (const [nth, source] of wish.sources.entries()) {
    const asset = source.asset === null ? null : await wish.fileOf(source.asset);
    if (!isWanted()) return null;
    const { show, frame, robots, quality } = wish;
    const answer = await maker.make(requestOf(show, frame, source, robots, quality), asset);
    if (answer === null) return null;
    const name = wish.sources.length > 1 ? (wish.draft.files[nth]?.name ?? '') : null;
    if (answer.error) return failed(named(answer.error, name));
    pictures.push({ source, name: name && stem(name), airTime_s: null, answer });
  }
  return { pictures, slowdown: 1, notes: [], error: null };
}

/** The error, with the file's name before its message if there is a name. */
const named = (error: MakeRemark, file: string | null): MakeRemark =>
  file === null ? error : { ...error, message: `${file}: ${error.message}` };

async function film(maker: Maker, wish: Wish): Promise<Pictures | null> {
  const [source] = wish.sources;
  const [file] = wish.draft.files;
  if (!source || !file) return null;
  const bytes = await wish.fileOf(file.hash);
  const named = { ...wish.frame, name: stem(file.name) };
  const request = requestOf(wish.show, named, source, wish.robots, wish.quality);
  const answer = await maker.film(request, bytes);
  if (answer === null) return null;
  const pictures = answer.frames.map((picture, nth) => ({
    source: { ...source, series: named.name, moment_s: picture.moment_s },
    name: `${named.name} ${nth + 1}`,
    airTime_s: picture.air_time_s,
    answer: picture.made,
  }));
  return { pictures, slowdown: answer.slowdown, notes: answer.notes, error: answer.error };
}
