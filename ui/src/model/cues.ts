import { withId, withRest } from './frameIds';
import type { Frame, Show } from './show';

/** A cue as the document has it. With `frame`, the show waits for GO at the end of that frame's air time. */
interface CueJson {
  name?: unknown;
  frame?: unknown;
  /** Id of `frame` or of a frame before it: the show repeats from that one to `frame` until GO, instead of waiting. */
  loop_from?: unknown;
}

const cuesOf = (show: Show): readonly CueJson[] =>
  Array.isArray(show.rest.cues) ? (show.rest.cues as CueJson[]) : [];

const withCues = (show: Show, cues: readonly CueJson[]) => withRest(show, 'cues', cues);

const ofFrame = (show: Show, frame: Frame | undefined) =>
  frame && frame.id !== null ? cuesOf(show).find((one) => one.frame === frame.id) : undefined;

/** Name of the cue at which a frame waits for GO; it may be empty. Null: the frame does not wait. */
export function cueOf(show: Show, frame: Frame | undefined): string | null {
  const cue = ofFrame(show, frame);
  return cue ? (typeof cue.name === 'string' ? cue.name : '') : null;
}

/**
 * Index of the frame from which the show repeats until GO, by the cue of the frame at `index`. Null: it does not
 * repeat. `lost`: the cue names a frame that is not there or comes later, so that the show waits.
 */
export function loopFrom(show: Show, index: number): number | 'lost' | null {
  const from = ofFrame(show, show.frames[index])?.loop_from;
  if (from === undefined) return null;
  const first = show.frames.findIndex((frame) => frame.id === from);
  return first >= 0 && first <= index ? first : 'lost';
}

/** How the show goes on after the frame at `index`; null: by itself. */
export function goOf(show: Show, index: number): 'waits' | 'repeats' | null {
  if (cueOf(show, show.frames[index]) === null) return null;
  return typeof loopFrom(show, index) === 'number' ? 'repeats' : 'waits';
}

/** Lets the show wait for GO after each of these frames, at a cue of that name; null: it goes on by itself. */
export const setCue = (show: Show, indices: readonly number[], name: string | null): Show =>
  indices.reduce((now, index) => setOne(now, index, name), show);

function setOne(show: Show, index: number, name: string | null): Show {
  const frame = show.frames[index];
  if (!frame || cueOf(show, frame) === name) return show;
  const [named, id] = withId(show, index) ?? [show, ''];
  const others = cuesOf(show).filter((cue) => cue.frame !== id);
  if (name === null) return withCues(show, others);
  return withCues(named, [...others, { ...ofFrame(show, frame), name, frame: id }]);
}

/** Lets the cue of frame `index` repeat from frame `from` until GO; null: it only waits. No change without a cue. */
export function setLoop(show: Show, index: number, from: number | null): Show {
  const cue = ofFrame(show, show.frames[index]);
  if (!cue || loopFrom(show, index) === from) return show;
  const others = Object.entries(cue).filter(([field]) => field !== 'loop_from');
  const waiting = Object.fromEntries(others) as CueJson;
  const [named, id] = (from === null ? null : withId(show, from)) ?? [show, null];
  const changed = id === null ? waiting : { ...waiting, loop_from: id };
  return withCues(
    named,
    cuesOf(show).map((one) => (one === cue ? changed : one)),
  );
}

/** `show` without cues of frames that only `before` has. A loop that lost its first frame begins with the next one. */
export function withoutLostCues(before: Show, show: Show): Show {
  const kept = new Set(show.frames.map((f) => f.key));
  const lost = new Set(before.frames.flatMap((f) => (kept.has(f.key) ? [] : [f.id])));
  const cues = cuesOf(show);
  const left = cues.filter((cue) => !lost.has(cue.frame as string | null));
  const shorter = left.length === cues.length ? show : withCues(show, left);
  return before.frames.reduce((now, frame, last) => {
    const from = loopFrom(before, last);
    if (!kept.has(frame.key) || typeof from !== 'number') return now;
    const first = before.frames.findIndex((one, i) => i >= from && kept.has(one.key));
    const place = (i: number) => now.frames.findIndex((one) => one.key === before.frames[i]?.key);
    return first === from ? now : setLoop(now, place(last), place(first));
  }, shorter);
}
