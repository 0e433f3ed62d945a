import { messageOf } from '../base/errors';
import { getShow, listShows } from '../api/http';
import { createStore, type Readable } from '../base/store';
import { readShow } from '../model/json';
import { followAddress, nameInAddress, showInAddress, viewNow } from './address';
import type { Live, Opened } from './live';

/** The show that the editor of this screen shows. */
export interface Shown extends Omit<Opened, 'revision'> {
  /** Why the show cannot be shown; null: it is shown, or it is still being loaded. */
  failure: string | null;
}

const NOTHING: Shown = { name: null, etag: null, readOnly: null, show: null, failure: null };

/**
 * The show of this screen's editor: in the edit view, the one that the address names, so that no other screen changes
 * it by opening a show. An address without a name gets the name of the open show.
 */
export function createShown(live: Pick<Live, 'opened'>): Readable<Shown> {
  const shown = createStore(NOTHING);
  const look = () => {
    if (viewNow() !== 'edit') return;
    const { revision, ...opened } = live.opened.get();
    // The server has not said yet which show is open.
    if (revision < 0) return;
    const named = showInAddress();
    if (named === null && opened.name !== null) nameInAddress(opened.name);
    if (named === null || named === opened.name) shown.set({ ...opened, failure: null });
    else if (named !== shown.get().name) void load(named);
  };
  const load = async (name: string) => {
    shown.set({ ...NOTHING, name });
    const isWanted = () => shown.get().name === name && shown.get().show === null;
    try {
      const [{ document, etag }, entries] = await Promise.all([getShow(name), listShows()]);
      const readOnly = entries.find((entry) => entry.name === name)?.read_only ?? null;
      if (isWanted()) shown.set({ name, etag, readOnly, show: readShow(document), failure: null });
    } catch (error) {
      const failure = messageOf(error);
      if (isWanted()) shown.set({ ...NOTHING, name, failure });
    }
  };
  live.opened.subscribe(look);
  followAddress(look);
  look();
  return shown;
}
