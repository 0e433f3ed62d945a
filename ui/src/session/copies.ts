import type { ShowEntry } from '../api/types.gen';
import { editShow, showInAddress } from './address';
import { notify } from './notices';
import { openShow } from './openShow';
import type { Session } from './session';

const WHY = {
  saved: '',
  example: 'Examples are read-only. ',
  start_file: 'LightBots does not change the file it was started with. ',
} as const;

/** The notice after a save that became a copy. */
export const copyText = ({ name, copy_of }: Pick<ShowEntry, 'name' | 'copy_of'>) =>
  `${WHY[copy_of ?? 'saved']}Saved as "${name}".`;

/**
 * Call after a save of show `from` that became a copy. Tells the user. If `from` is open on the server, opens the copy
 * there; else, if this screen edits `from`, edits the copy. An action that waits for `from` also accepts the copy.
 */
export function followCopy({ live, waiting, ask }: Context, from: string, copy: ShowEntry) {
  notify('kept', copyText(copy));
  waiting.update((pending) =>
    pending?.names.includes(from) ? { ...pending, names: [...pending.names, copy.name] } : pending,
  );
  if (live.opened.get().name === from) void openShow({ live, ask }, copy.name);
  else if (showInAddress() === from) editShow(copy.name);
}

type Context = Pick<Session, 'live' | 'waiting' | 'ask'>;
