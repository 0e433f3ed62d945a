import { createChoice } from '../session/preferences';
import type { Viewpoint } from '../stage/projection';

const isViewpoint = (text: string | null): text is Viewpoint =>
  text === 'above' || text === 'front';

/** From where the audience view of this screen shows the floor, kept in the browser. */
export const viewpointStore = createChoice<Viewpoint>(
  'lightbots-audience-viewpoint',
  'above',
  isViewpoint,
);

export const turnViewpoint = () =>
  viewpointStore.set(viewpointStore.get() === 'above' ? 'front' : 'above');
