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
  const cancel = () => {
    current.current?.cancel();
    current.current = null;
    setState({ of: 'settings' });
  };
  useEffect(() => () => current.current?.cancel(), []);
  const make = async (plan: Plan, settings: FilmSettings, withMusic: boolean) => {
    const show = editing.editor.state.get().show;
    setState({ of: 'making', share: 0 });
    try {
      const file = withMusic ? musicOf(show) : null;
      const music = file && (await decodeForFilm(await editing.fileOf(file.hash)));
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
      setState({ of: 'failed', message: messageOf(error) });
    }
    current.current = null;
  };
  return { state, make, cancel };
}
