import { createChoice } from '../../session/preferences';

/** How the frames are shown below the stage. */
export type FramesView = 'pictures' | 'timeline';

const isFramesView = (text: unknown): text is FramesView =>
  text === 'pictures' || text === 'timeline';

/** How this screen shows frames, kept in the browser. */
export const framesView = createChoice<FramesView>(
  'lightbots-frames-view',
  'pictures',
  isFramesView,
);

export const toggleFramesView = () =>
  framesView.set(framesView.get() === 'pictures' ? 'timeline' : 'pictures');
