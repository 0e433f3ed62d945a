import type { ShowEntry } from '../api/types.gen';
import { tell } from './notices';
import type { Session } from './session';

const WHY = {
  saved: '',
  example: 'Examples are read-only. ',
  start_file: 'LightBots does not change the file it was started with. ',
} as const;

/** What people are told when a save became a copy. */
export const copyText = ({ name, copy_of }: Pick<ShowEntry, 'name' | 'copy_of'>) =>
  `${WHY[copy_of ?? 'saved']}Saved as "${name}".`;

/** A read-only show was saved as a copy: says so, and every screen that shows it goes on with the copy. */
export function followCopy({ live, waiting, ask }: Desk, from: string, copy: ShowEntry) {
  tell('kept', copyText(copy));
  waiting.update((wish) =>
    wish?.names.includes(from) ? { ...wish, names: [...wish.names, copy.name] } : wish,
  );
  if (live.opened.get().name === from) void ask({ do: 'open', name: copy.name });
}

type Desk = Pick<Session, 'live' | 'waiting' | 'ask'>;
