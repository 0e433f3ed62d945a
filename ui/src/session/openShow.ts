import { editShow, viewNow } from './address';
import type { Session } from './session';

type Context = Pick<Session, 'live' | 'ask'>;

/** Opens a show for all screens, and in this screen's editor if that is what it shows. Answers whether it is open here. */
export async function openShow({ live, ask }: Context, name: string): Promise<boolean> {
  const { revision } = live.opened.get();
  if (!(await ask({ do: 'open', name })).ok) return false;
  await isAnnounced(live, revision);
  if (live.opened.get().name !== name) return false;
  if (viewNow() === 'edit') editShow(name);
  return true;
}

/** Ends when the server has announced a show since that revision, or when the connection is lost. */
const isAnnounced = ({ opened, link }: Session['live'], before: number) =>
  new Promise<void>((resolve) => {
    if (opened.get().revision !== before) return resolve();
    const end = () => {
      stops.forEach((stop) => stop());
      resolve();
    };
    const stops = [opened.subscribe(end), link.subscribe(end)];
  });
