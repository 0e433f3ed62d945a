import { messageOf } from '../../base/errors';
import { bare } from '../../make/drive';
import { writeShow } from '../../model/json';
import { isOfFormation, type Motion, type MotionKind } from '../../model/motion';
import { setMotion, usualMotion, type MovedPlaces } from '../../model/movedFrames';
import type { Frame, Show } from '../../model/show';
import { notify } from '../../session/notices';
import type { Editing } from '../editing';

/** Gives the frame on the stage the usual motion of a kind; null: the planner's shortest drive. Not the first frame. */
export function chooseMotion(editing: Editing, kind: MotionKind | null) {
  const { before } = framesNow(editing);
  if (before) void applyMotion(editing, kind && usualMotion(kind, before));
}

/** Gives the frame on the stage a motion and, where the picture moves as a whole, its pixels the places it leads to. */
export async function applyMotion(editing: Editing, motion: Motion | null) {
  const { show, before, frame } = framesNow(editing);
  if (!before || !frame) return;
  const moved =
    motion && isOfFormation(motion) ? await placesAfter(editing, show, before, motion) : null;
  if (moved === 'none') return;
  editing.editor.change('Motion', (now) => setMotion(now, frame.key, motion, moved));
}

function framesNow({ editor }: Editing) {
  const { show, frame } = editor.state.get();
  return { show, before: show.frames[frame - 1], frame: show.frames[frame] };
}

/** Where the module says that the pixels of `before` are after a motion; `none`: it failed, and a notice says why. */
async function placesAfter(
  { maker }: Editing,
  show: Show,
  before: Frame,
  motion: Motion,
): Promise<MovedPlaces | 'none'> {
  const frames = [bare(before), { ...bare(before), motion }];
  const text = JSON.stringify(writeShow({ ...show, music: null, frames, rest: {} }));
  try {
    const answer = await maker.moved(new TextEncoder().encode(text));
    if (!answer.error) return new Map(answer.pixels.map(({ id, place: [x, y] }) => [id, { x, y }]));
    notify('error', answer.error.message);
  } catch (error) {
    notify('error', messageOf(error));
  }
  return 'none';
}
