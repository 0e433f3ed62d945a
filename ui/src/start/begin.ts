import { messageOf } from '../base/errors';
import type { Maker } from '../make/maker';
import { makeTemplate } from '../make/templateShow';
import type { TemplateFrame } from '../make/templates';
import type { Stage } from '../model/show';
import { createShowInLibrary } from '../session/createShow';
import { notify } from '../session/notices';
import type { Session } from '../session/session';
import { goTo } from '../session/address';

/** Number of robots and floor for which a new show is made. */
export interface Fleet {
  robots: number;
  stage: Stage;
}

/** Makes a show, opens it on every screen and goes to the editor. `told` gets the number of frames made, after each. */
export async function beginWith(
  session: Session,
  maker: Maker,
  { robots, stage }: Fleet,
  title: string,
  frames: readonly TemplateFrame[],
  told: (made: number) => void,
) {
  try {
    const made = await makeTemplate(maker, frames, robots, stage, told);
    const show = { title, stage, frames: made };
    if ((await createShowInLibrary(session, show)) !== null) goTo('edit');
  } catch (error) {
    const why = messageOf(error);
    notify('error', `The show is not made. ${why}`);
  }
}

/** Begins a new show with one frame, all robots in rows, and goes to the editor. */
export async function beginEmpty(session: Session, { stage }: Fleet) {
  if ((await createShowInLibrary(session, { stage })) !== null) goTo('edit');
}

/** Begins a new show and goes to the editor, which takes the files as if they were dropped. */
export async function beginWithFiles(session: Session, { stage }: Fleet, files: readonly File[]) {
  const into = await createShowInLibrary(session, { stage });
  if (into === null) return;
  session.dropped.set({ files, text: '', into });
  goTo('edit');
}
