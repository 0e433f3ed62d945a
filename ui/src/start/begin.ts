import { messageOf } from '../base/errors';
import type { Maker } from '../make/maker';
import { makeTemplate } from '../make/templateShow';
import type { TemplateFrame } from '../make/templates';
import type { Stage } from '../model/show';
import { createShowInLibrary } from '../session/createShow';
import { notify } from '../session/notices';
import type { Session } from '../session/session';
import { goTo } from '../session/address';

/** What a new show is made for. */
export interface Fleet {
  robots: number;
  stage: Stage;
}

/** Makes a show, opens it on every screen and leads to the editor. `told` hears how many frames are made. */
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

/** A show with all robots at the back edge. */
export async function beginEmpty(session: Session, { stage }: Fleet) {
  if ((await createShowInLibrary(session, { stage })) !== null) goTo('edit');
}

/** A new show whose first frame the Make panel makes of files. */
export async function beginWithFiles(session: Session, { stage }: Fleet, files: readonly File[]) {
  const into = await createShowInLibrary(session, { stage });
  if (into === null) return;
  session.dropped.set({ files, text: '', into });
  goTo('edit');
}
