import { createChoice } from '../../session/preferences';

type OnOff = 'on' | 'off';

const isOnOff = (text: string | null): text is OnOff => text === 'on' || text === 'off';

/** Whether this screen plays the music with the preview. */
export const previewSound = createChoice<OnOff>('lightbots-preview-sound', 'on', isOnOff);
