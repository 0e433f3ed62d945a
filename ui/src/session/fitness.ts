import type { FleetRow } from '../api/types.gen';
import { sparesOf } from '../model/commands';
import type { Show } from '../model/show';
import { viewNow } from './address';
import { canDrive } from './checklist';
import type { Session } from './session';

/**
 * The number of robots that can drive, if a show should be fitted to it. Null: each frame fits it, spare robots counted
 * in, or no robot can drive, or there is no show that can be saved.
 */
export function robotsToFit(
  show: Show | null,
  readOnly: string | null,
  rows: readonly FleetRow[],
): number | null {
  const here = rows.filter(canDrive).length;
  if (!show || readOnly !== null || here === 0) return null;
  const fits = (count: number) => count <= here && here <= count + sparesOf(show);
  return show.frames.every(({ pixels }) => fits(pixels.length)) ? null : here;
}

/** The show that the user looks at: in the edit view the editor's, in other views the one open on the server. */
export const lookedAt = ({ live, shown }: Pick<Session, 'live' | 'shown'>) =>
  (viewNow() === 'edit' ? shown : live.opened).get();

/** The show that the user looks at, with this screen's edits, saved or not; null: there is none. */
export function showNow(session: Pick<Session, 'live' | 'shown' | 'editing'>): Show | null {
  const { name, show } = lookedAt(session);
  const mine = session.editing.get();
  return mine !== null && mine.name === name ? mine.editor.state.get().show : show;
}
