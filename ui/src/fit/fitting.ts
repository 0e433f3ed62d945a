import { convertShow } from '../api/http';
import type { MakeRemark } from '../api/types.gen';
import type { Maker } from '../make/maker';
import { readShow, writeShow } from '../model/json';
import type { Show } from '../model/show';

/** A show for another number of robots, and remarks about it. */
export interface Fitted {
  show: Show;
  notes: readonly MakeRemark[];
}

/**
 * Fits the frames of a show to a number of robots. Pixels that were made from sources are made anew, for which the
 * server adds the files of the show. Throws a text for people if it cannot be done.
 */
export async function fitShow(maker: Maker, show: Show, robots: number): Promise<Fitted> {
  const file = await convertShow(JSON.stringify(writeShow(show)), 'archive');
  const answer = await maker.fit(new Uint8Array(await file.arrayBuffer()), robots);
  if (answer.error) throw new Error(answer.error.message);
  return { show: withPixels(show, readShow(answer.show)), notes: answer.notes };
}

/** The show with pixels, sources and `rest` of `fitted`; unchanged if that has another number of frames. */
export function withPixels(show: Show, fitted: Show): Show {
  if (show.frames.length !== fitted.frames.length) return show;
  const frames = show.frames.map((frame, i) => {
    const { pixels = frame.pixels, sources = frame.sources } = fitted.frames[i] ?? {};
    return { ...frame, pixels, sources };
  });
  // `rest` of the fitted show has no starting places for the old number of robots.
  return { ...show, frames, rest: fitted.rest };
}
