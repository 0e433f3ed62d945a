import type { FleetRow } from '../api/types.gen';
import type { Show } from '../model/show';
import { canDrive } from './checklist';
import type { Session } from './session';

/** The number of robots that a show should be fitted to; null: it fits, no robot is here, or the show cannot be saved. */
export function robotsToFit(
  show: Show | null,
  readOnly: string | null,
  rows: readonly FleetRow[],
): number | null {
  const here = rows.filter(canDrive).length;
  if (!show || readOnly !== null || here === 0) return null;
  return show.frames.some(({ pixels }) => pixels.length !== here) ? here : null;
}

/** The open show as this screen has it, which may not be saved yet. */
export function showNow({ live, editing }: Pick<Session, 'live' | 'editing'>): Show | null {
  const opened = live.opened.get();
  const mine = editing.get();
  return mine !== null && mine.name === opened.name ? mine.editor.state.get().show : opened.show;
}
