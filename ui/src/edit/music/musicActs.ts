import { messageOf } from '../../base/errors';
import { putAsset } from '../../api/http';
import type { BeatsAnswer } from '../../api/types.gen';
import { PER_BAR, withMusic, type Beats } from '../../model/beats';
import { decodeMusic, LONG_S } from '../../music/decode';
import { notify } from '../../session/notices';
import type { Editing, TakenFile } from '../editing';

/** What a file chooser offers. A dropped file may have another ending: its bytes say what it is. */
export const MUSIC_FILES = 'audio/*,.mp3,.ogg,.oga,.opus,.wav,.flac,.m4a,.aac';

/** Makes a file the music of the show, with the beats found in it, if any, as one step of the history. */
export async function takeMusic(editing: Editing, { hash, name, mediaType, bytes }: TakenFile) {
  const { editor, maker, music } = editing;
  try {
    notify('info', `Reading ${name} and finding its beats…`);
    const decoded = await decodeMusic(bytes);
    const answer = await maker.beats(decoded.samples, decoded.rate_Hz);
    await putAsset(hash, bytes);
    music.add(hash, decoded);
    const beats = beatsFound(answer);
    const file = { hash, name, mediaType, bytes: bytes.length };
    editor.change('Music', (show) => withMusic(show, file, beats));
    if (answer.error) notify('info', answer.error.message);
    if (decoded.samples.length / decoded.rate_Hz > LONG_S)
      notify(
        'info',
        'Music of more than 20 min needs much memory in a browser: cut it to the show.',
      );
  } catch (error) {
    notify('error', `Can't use ${name}: ${messageOf(error)}`);
  }
}

/** Finds the beats of the show's music again; null: that failed, and a notice says why. */
export async function findBeatsAgain({ maker, music }: Editing): Promise<Beats | null> {
  try {
    const { samples, rate_Hz } = await music.decode();
    const answer = await maker.beats(samples, rate_Hz);
    if (answer.error) notify('info', answer.error.message);
    return beatsFound(answer);
  } catch (error) {
    notify('error', messageOf(error));
    return null;
  }
}

function beatsFound({ bpm, offset_s, times_s, error }: BeatsAnswer): Beats | null {
  if (error) return null;
  const grid: Beats['grid'] =
    offset_s === null ? { of: 'times', times_s } : { of: 'steady', bpm, offset_s };
  return { grid, perBar: PER_BAR };
}
