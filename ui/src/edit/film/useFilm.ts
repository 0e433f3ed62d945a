import { useEffect, useRef, useState } from 'react';
import type { Plan } from '../../api/types.gen';
import { messageOf } from '../../base/errors';
import { startFilmWorker } from '../../film/browserWorker';
import { decodeForFilm } from '../../film/filmMusic';
import { startFilm, type Filming } from '../../film/filming';
import type { FilmSettings } from '../../film/protocol';
import { musicOf } from '../../model/beats';
import { download } from '../../session/download';
import type { Editing } from '../editing';

/** How far a film is: not begun, the share that is painted (0 to 1), its size in bytes, or why there is none. */
export type FilmState =
  | { of: 'settings' }
  | { of: 'making'; share: number }
  | { of: 'made'; bytes: number }
  | { of: 'failed'; message: string };

/** Makes films of the show that is edited, and saves them. */
export function useFilm(editing: Editing) {
  const [state, setState] = useState<FilmState>({ of: 'settings' });
  const current = useRef<Filming | null>(null);
  const cancels = useRef(0);
  const end = () => {
    cancels.current += 1;
    current.current?.cancel();
    current.current = null;
  };
  const cancel = () => {
    end();
    setState({ of: 'settings' });
  };
  useEffect(() => end, []);
  const make = async (plan: Plan, settings: FilmSettings, withMusic: boolean) => {
    const show = editing.editor.state.get().show;
    setState({ of: 'making', share: 0 });
    const before = cancels.current;
    const isCancelled = () => cancels.current !== before;
    try {
      const file = withMusic ? musicOf(show) : null;
      const music = file && (await decodeForFilm(await editing.fileOf(file.hash)));
      if (isCancelled()) return;
      const filming = startFilm(
        startFilmWorker,
        { show, transitions: plan.transitions },
        { settings, music },
        editing.fileOf,
        (share) => setState({ of: 'making', share }),
      );
      current.current = filming;
      const film = await filming.film;
      const type = settings.kind === 'mp4' ? 'video/mp4' : 'video/webm';
      download(new Blob([film], { type }), `${editing.name}.${settings.kind}`);
      setState({ of: 'made', bytes: film.length });
    } catch (error) {
      if (isCancelled()) return;
      setState({ of: 'failed', message: messageOf(error) });
    }
    current.current = null;
  };
  return { state, make, cancel };
}
