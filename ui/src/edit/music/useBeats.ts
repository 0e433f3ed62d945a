import { useMemo } from 'react';
import { beatsOf, type Beats } from '../../model/beats';
import { useEditorNow } from '../context';

/** The beats of the edited show; the same object while they stay. Null: they are not known. */
export function useBeats(): Beats | null {
  const beats = useEditorNow((s) => s.show.rest.beats);
  return useMemo(() => beatsOf({ rest: { beats } }), [beats]);
}
