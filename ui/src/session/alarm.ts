import { useStore, type Store } from '../base/store';
import type { Incident } from '../api/types.gen';
import { viewNow } from './address';
import { isHeard } from './incidents';
import { createChoice } from './preferences';

/** The two notes of the alarm, in the order in which they sound, hertz. */
const NOTES_HZ = [660, 880];
/** Length of each note, seconds. */
const NOTE_S = 0.14;

const isSound = (text: string | null): text is 'on' | 'off' => text === 'on' || text === 'off';

const sound = createChoice<'on' | 'off'>('lightbots-sound', 'on', isSound);

/** Whether this screen makes a sound when something goes wrong. */
export const useSound = () => useStore(sound) === 'on';

export const setSound = (on: boolean) => sound.set(on ? 'on' : 'off');

/**
 * Plays one alarm when the list gains unread incidents that are not mere information. The first list is silent. The
 * audience view and a screen with its sound switched off play none.
 */
export function soundAlarms(incidents: Store<readonly Incident[]>) {
  let last: number | null = null;
  let audio: AudioContext | null = null;
  incidents.subscribe(() => {
    const list = incidents.get();
    const newest = list.at(-1)?.id ?? 0;
    const isWanted = sound.get() === 'on' && viewNow() !== 'audience';
    if (last !== null && isWanted && list.some((one) => isHeard(one, last ?? 0))) {
      audio ??= new AudioContext();
      play(audio);
    }
    last = Math.max(newest, last ?? 0);
  });
}

/** Plays the two notes. Browsers allow a sound only after the first press on the page: until then, nothing is heard. */
function play(audio: AudioContext) {
  if (audio.state === 'suspended') void audio.resume().catch(() => undefined);
  const volume = audio.createGain();
  volume.gain.value = 0.15;
  volume.connect(audio.destination);
  NOTES_HZ.forEach((hz, i) => {
    const note = audio.createOscillator();
    note.frequency.value = hz;
    note.connect(volume);
    note.start(audio.currentTime + i * NOTE_S);
    note.stop(audio.currentTime + (i + 1) * NOTE_S);
  });
}
