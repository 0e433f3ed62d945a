import { withId, withRest } from './frameIds';
import type { Frame, Show } from './show';

/** A cue as the document has it: the show waits for GO at the end of a frame's air time, or at a moment. */
interface CueJson {
  name?: unknown;
  frame?: unknown;
}

const cuesOf = (show: Show): readonly CueJson[] =>
  Array.isArray(show.rest.cues) ? (show.rest.cues as CueJson[]) : [];

const withCues = (show: Show, cues: readonly CueJson[]) => withRest(show, 'cues', cues);

/** Name of the cue at which a frame waits for GO; it may be empty. Null: the frame does not wait. */
export function cueOf(show: Show, frame: Frame | undefined): string | null {
  if (!frame || frame.id === null) return null;
  const cue = cuesOf(show).find((one) => one.frame === frame.id);
  return cue ? (typeof cue.name === 'string' ? cue.name : '') : null;
}

/** Lets frames wait for GO at a cue of that name, or not; null: they go on by themselves. */
export const setCue = (show: Show, indices: readonly number[], name: string | null): Show =>
  indices.reduce((now, index) => setOne(now, index, name), show);

function setOne(show: Show, index: number, name: string | null): Show {
  const frame = show.frames[index];
  if (!frame || cueOf(show, frame) === name) return show;
  const [named, id] = withId(show, index) ?? [show, ''];
  const others = cuesOf(show).filter((cue) => cue.frame !== id);
  if (name === null) return withCues(show, others);
  return withCues(named, [...others, { name, frame: id }]);
}

/** The show without the cues of frames that it no longer has. */
export function withoutLostCues(before: Show, show: Show): Show {
  const kept = new Set(show.frames.map((f) => f.id));
  const lost = new Set(before.frames.flatMap((f) => (kept.has(f.id) ? [] : [f.id])));
  const cues = cuesOf(show);
  const left = cues.filter((cue) => !lost.has(cue.frame as string | null));
  return left.length === cues.length ? show : withCues(show, left);
}
