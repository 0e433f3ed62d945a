import { expect, test } from 'vitest';
import { deleteFrames, moveFrames } from './commands';
import { readShow, writeShow } from './json';
import {
  addLayer,
  framesOf,
  layersOf,
  moveLayer,
  removeLayer,
  setLayer,
  setLayerFrames,
  setLayerSettings,
  type Layer,
} from './layers';
import { newFrame, newShow, type Show } from './show';

const layer = (kind: string): Layer => ({
  kind,
  name: '',
  settings: {},
  when: { of: 'show' },
  rest: {},
});

/** Frames A to E, the layer over B to D. */
function withFrames(): Show {
  const frames = ['A', 'B', 'C', 'D', 'E'].map((name) => newFrame(name, []));
  const show = addLayer({ ...newShow('Test', 2), frames }, layer('fire'));
  return setLayerFrames(show, 0, [3, 1], 'picture');
}

const over = (show: Show) => {
  const [only] = layersOf(show);
  const range = only && framesOf(show, only);
  return range && show.frames.slice(range[0], range[1] + 1).map((frame) => frame.name);
};

test('layers of a document are read and written without a loss', () => {
  const layers = [
    { name: 'Sparks', kind: 'sparkle', frames: ['a', 'a'], phase: 'picture', settings: { x: [1] } },
    { kind: 'rainbow', from_s: 2, to_s: 8, later: true },
    { kind: 'of-tomorrow' },
  ];
  const frames = [{ id: 'a', name: 'A', pixels: [] }];
  const show = readShow({ lightbots: 2, frames, layers });
  expect(layersOf(show)).toBe(layersOf(show));
  const written = addLayer(removeLayer(addLayer(show, layer('fire')), 3), layer('fade'));
  expect(writeShow(removeLayer(written, 3))).toMatchObject({ lightbots: 2, layers });
  expect(writeShow(show)).toMatchObject({ layers });
});

test('a show whose last layer is taken out has no layers', () => {
  const show = newShow('Test', 2);
  expect(writeShow(removeLayer(addLayer(show, layer('fire')), 0))).toEqual(writeShow(show));
});

test('layers are moved, and a change that changes nothing is none', () => {
  const show = ['a', 'b', 'c'].reduce((now, kind) => addLayer(now, layer(kind)), newShow('T', 1));
  const kinds = (of: Show) => layersOf(of).map((one) => one.kind);
  expect(kinds(moveLayer(show, 0, 2))).toEqual(['b', 'c', 'a']);
  expect(kinds(moveLayer(show, 2, 0))).toEqual(['c', 'a', 'b']);
  for (const same of [moveLayer(show, 1, 1), moveLayer(show, 2, 3), moveLayer(show, 7, 0)])
    expect(same).toBe(show);
  expect(setLayer(show, 0, { kind: 'a' })).toBe(show);
  expect(setLayerSettings(show, 0, { speed_hz: undefined })).toBe(show);
});

test('a setting that is taken out is not written', () => {
  const show = setLayerSettings(addLayer(newShow('T', 1), layer('fire')), 0, {
    size_m: 2,
    seed: 3,
  });
  expect(layersOf(setLayerSettings(show, 0, { size_m: undefined }))[0]?.settings).toEqual({
    seed: 3,
  });
});

test('a layer stays over its frames when frames are moved or taken out', () => {
  const show = withFrames();
  expect(over(show)).toEqual(['B', 'C', 'D']);
  expect(over(deleteFrames(show, [0, 4]))).toEqual(['B', 'C', 'D']);
  expect(over(deleteFrames(show, [1]))).toEqual(['C', 'D']);
  expect(over(deleteFrames(show, [2, 3]))).toEqual(['B']);
  expect(layersOf(deleteFrames(show, [1, 2, 3]))).toEqual([]);
  expect(over(moveFrames(show, [1], 4))).toEqual(['D', 'B']);
  expect(over(moveFrames(show, [0], 3))).toEqual(['B', 'C', 'A', 'D']);
});
