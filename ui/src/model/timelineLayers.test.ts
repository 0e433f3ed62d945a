import { expect, test } from 'vitest';
import type { Plan } from '../api/types.gen';
import { addFrame, setFrames } from './commands';
import { addLayer, framesOf, layersOf, setLayerFrames, type Layer, type LayerWhen } from './layers';
import { newShow } from './show';
import { blocksOf, plannedDrives } from './timelineBlocks';
import { layerBar, moveLayerPart, stepLayerPart } from './timelineLayers';

const PLAN = {
  transitions: [0, 1, 2].map((to) => ({ to, duration_s: 3, least_s: 3 })),
} as unknown as Plan;
const three = setFrames(addFrame(addFrame(newShow('x', 4), 0), 1), [0, 1, 2], { airTime_s: 2 });
const layer = (when: LayerWhen): Layer => ({
  kind: 'rainbow',
  name: '',
  settings: {},
  when,
  rest: {},
});
const whenOf = (of: typeof three) => layersOf(of)[0]?.when;

test('a layer of seconds is moved by its ends and as a whole', () => {
  const show = addLayer(three, layer({ of: 'seconds', from_s: 1, to_s: 5 }));
  const blocks = blocksOf(show, plannedDrives(show, PLAN));
  const move = (part: 'from' | 'to' | 'whole', to_s: number) =>
    whenOf(moveLayerPart(show, blocks, 0, part, to_s));
  expect(move('from', 3.333)).toEqual({ of: 'seconds', from_s: 3.33, to_s: 5 });
  expect(move('from', 99)).toEqual({ of: 'seconds', from_s: 4.9, to_s: 5 });
  expect(move('to', -1)).toEqual({ of: 'seconds', from_s: 1, to_s: 1.1 });
  expect(move('whole', -3)).toEqual({ of: 'seconds', from_s: 0, to_s: 4 });
  expect(whenOf(stepLayerPart(show, blocks, 0, 'to', 0.5))).toMatchObject({ to_s: 5.5 });
  expect(moveLayerPart(show, blocks, 0, 'to', 5)).toBe(show);
});

test('a layer of frames goes from edge to edge', () => {
  const bare = addLayer(three, layer({ of: 'show' }));
  const show = setLayerFrames(bare, 0, [0, 0], 'picture');
  // Frames are shown from 0, 5 and 10 s on, for 2 s.
  const blocks = blocksOf(show, plannedDrives(show, PLAN));
  const [first] = layersOf(show);
  if (!first) throw new Error('There is no layer.');
  expect(layerBar(show, blocks, first)).toEqual({ from_s: 0, to_s: 2, hasEnds: true });
  const longer = moveLayerPart(show, blocks, 0, 'to', 6.8);
  const range = (of: typeof show) => layersOf(of).map((one) => framesOf(of, one))[0];
  expect(range(longer)).toEqual([0, 1]);
  expect(range(moveLayerPart(longer, blocks, 0, 'from', 99))).toEqual([1, 1]);
  expect(range(moveLayerPart(longer, blocks, 0, 'whole', 11))).toEqual([1, 2]);
  expect(range(stepLayerPart(longer, blocks, 0, 'to', 0.5))).toEqual([0, 2]);
  expect(stepLayerPart(show, blocks, 0, 'from', -0.5)).toBe(show);
});

test('a layer over the whole show has no ends, and one of lost frames no bar', () => {
  const show = addLayer(three, layer({ of: 'show' }));
  const blocks = blocksOf(show, plannedDrives(show, PLAN));
  expect(layerBar(show, blocks, layer({ of: 'show' }))).toEqual({
    from_s: -3,
    to_s: 12,
    hasEnds: false,
  });
  expect(moveLayerPart(show, blocks, 0, 'to', 4)).toBe(show);
  const lost = layer({ of: 'frames', first: 'a', last: 'b', phase: 'whole' });
  expect(layerBar(show, blocks, lost)).toBeNull();
});
