import { editShow, viewNow } from './address';
import type { Session } from './session';

type Context = Pick<Session, 'live' | 'ask'>;

/** Opens a show for all screens, and in this screen's editor if that is what it shows. Answers whether it is open here. */
export async function openShow({ live, ask }: Context, name: string): Promise<boolean> {
  const { revision } = live.opened.get();
  if (!(await ask({ do: 'open', name })).ok) return false;
  await isAnnounced(live, name, revision);
  if (live.opened.get().name !== name) return false;
  if (viewNow() === 'edit') editShow(name);
  return true;
}

/** The server announces a show right after it has opened it; another screen may open a third one in between. */
const ANNOUNCED_MS = 3_000;

/** Ends when the server has announced that show anew, when the connection is lost, or after a while. */
const isAnnounced = ({ opened, link }: Session['live'], name: string, before: number) =>
  new Promise<void>((resolve) => {
    const look = () => {
      const now = opened.get();
      const isOver = now.revision !== before && now.name === name;
      if (isOver || link.get() !== 'open') end();
    };
    const end = () => {
      clearTimeout(timer);
      stops.forEach((stop) => stop());
      resolve();
    };
    const timer = setTimeout(end, ANNOUNCED_MS);
    const stops = [opened.subscribe(look), link.subscribe(look)];
    look();
  });
