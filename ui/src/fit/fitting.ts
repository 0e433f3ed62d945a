import { convertShow } from '../api/http';
import type { MakeRemark } from '../api/types.gen';
import type { Maker } from '../make/maker';
import { readShow, writeShow } from '../model/json';
import type { Show } from '../model/show';

/** A show for another number of robots, and what is different from what might be expected. */
export interface Fitted {
  show: Show;
  notes: readonly MakeRemark[];
}

/**
 * Fits every frame of a show to a number of robots. Pixels that were made from sources flow anew, for which the server adds
 * the files of the show. An error says which frame finds no room, and why.
 */
export async function fitShow(maker: Maker, show: Show, robots: number): Promise<Fitted> {
  const file = await convertShow(JSON.stringify(writeShow(show)), 'archive');
  const answer = await maker.fit(new Uint8Array(await file.arrayBuffer()), robots);
  if (answer.error) throw new Error(answer.error.message);
  return { show: withPixels(show, readShow(answer.show)), notes: answer.notes };
}

/** The show with the pixels of another one that has the same frames; the same show if it has not. */
export function withPixels(show: Show, fitted: Show): Show {
  if (show.frames.length !== fitted.frames.length) return show;
  const frames = show.frames.map((frame, i) => {
    const { pixels = frame.pixels, sources = frame.sources } = fitted.frames[i] ?? {};
    return { ...frame, pixels, sources };
  });
  // Where robots start is dropped with their old number.
  return { ...show, frames, rest: fitted.rest };
}
