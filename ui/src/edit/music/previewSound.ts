import { createChoice } from '../../session/preferences';

type OnOff = 'on' | 'off';

const isOnOff = (text: string | null): text is OnOff => text === 'on' || text === 'off';

/** Whether the music is heard with the preview on this screen. */
export const previewSound = createChoice<OnOff>('lightbots-preview-sound', 'on', isOnOff);
