import { editShow, viewNow } from './address';
import type { Session } from './session';

type Context = Pick<Session, 'live' | 'ask'>;

/** Opens a show on every screen; in the edit view, this screen's editor changes to it. Answers whether it is open. */
export async function openShow({ live, ask }: Context, name: string): Promise<boolean> {
  const { revision } = live.opened.get();
  if (!(await ask({ do: 'open', name })).ok) return false;
  await isAnnounced(live, name, revision);
  if (live.opened.get().name !== name) return false;
  if (viewNow() === 'edit') editShow(name);
  return true;
}

/** Longest wait for the announcement of a show, milliseconds. It never comes if another screen opens another show. */
const ANNOUNCED_MS = 3_000;

/** Resolves when `name` is open with a revision other than `before`, without a connection, or after `ANNOUNCED_MS`. */
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
