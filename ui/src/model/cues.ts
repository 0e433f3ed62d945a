import type { Frame, Show } from './show';

/** A cue as the document has it: the show waits for GO at the end of a frame's air time, or at a moment. */
interface CueJson {
  name?: unknown;
  frame?: unknown;
}

const cuesOf = (show: Show): readonly CueJson[] =>
  Array.isArray(show.rest.cues) ? (show.rest.cues as CueJson[]) : [];

function withCues(show: Show, cues: readonly CueJson[]): Show {
  const others = Object.entries(show.rest).filter(([field]) => field !== 'cues');
  const all = cues.length === 0 ? others : [...others, ['cues', cues] as const];
  return { ...show, rest: Object.fromEntries(all) };
}

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
  const id = frame.id ?? freeId(show);
  const others = cuesOf(show).filter((cue) => cue.frame !== id);
  if (name === null) return withCues(show, others);
  const frames = show.frames.map((f) => (f === frame ? { ...f, id } : f));
  return withCues({ ...show, frames }, [...others, { name, frame: id }]);
}

/** The show without the cues of frames that it no longer has. */
export function withoutLostCues(before: Show, show: Show): Show {
  const kept = new Set(show.frames.map((f) => f.id));
  const lost = new Set(before.frames.flatMap((f) => (kept.has(f.id) ? [] : [f.id])));
  const cues = cuesOf(show);
  const left = cues.filter((cue) => !lost.has(cue.frame as string | null));
  return left.length === cues.length ? show : withCues(show, left);
}

/** A word that no frame has. */
function freeId(show: Show): string {
  const taken = new Set(show.frames.map((f) => f.id));
  for (let n = 1; ; n++) if (!taken.has(`f${n}`)) return `f${n}`;
}
