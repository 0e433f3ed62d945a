import { expect, test } from 'vitest';
import { createEditor } from './editor';
import { addLayer, layersOf, type Layer } from './layers';
import { createLayerTool, layerGripAt, layerGrips } from './layerTool';
import { newShow } from './show';
import type { Touch } from './tool';

const layer = (settings: Layer['settings'], kind = 'wave'): Layer => ({
  kind,
  name: '',
  settings,
  when: { of: 'show' },
  rest: {},
});
const touch = (x: number, y: number, shift = false): Touch => ({
  at: { x, y },
  reach_m: 0.05,
  shift,
  alt: false,
  ctrl: false,
  again: false,
});
const cm = (m: number) => `${Math.round(m * 100)} cm`;

test('effects have the handles that change them', () => {
  const grips = (one: Layer) => layerGrips(one).map(({ grip }) => grip);
  expect(grips(layer({}))).toEqual(['place', 'end']);
  expect(grips(layer({ along: 'distance' }))).toEqual(['place', 'end']);
  expect(grips(layer({ along: 'order' }))).toEqual([]);
  expect(grips(layer({}, 'fade'))).toEqual([]);
  expect(layerGripAt(layer({ place: [1, 0], size_m: 0.5 }), touch(1.52, 0))).toBe('end');
  expect(layerGripAt(layer({ place: [1, 0], size_m: 0.01 }), touch(1, 0))).toBe('end');
  expect(layerGripAt(layer({}), touch(0, 0.2))).toBeNull();
});

test('a drag of the end sets span and direction as one change, and Escape takes it back', () => {
  const editor = createEditor(addLayer(newShow('T', 1), layer({ place: [1, 0] })));
  const settings = () => layersOf(editor.state.get().show)[0]?.settings;
  const tool = createLayerTool(0, 'end', cm);
  tool.down(editor, touch(2, 0));
  tool.move(editor, touch(1.2, 0.1));
  tool.move(editor, touch(1, 0.5));
  expect(editor.state.get().overlay.hint).toBe('50 cm, 90°');
  tool.up(editor, touch(1, 0.5));
  expect(settings()).toEqual({ place: [1, 0], size_m: 0.5, angle: 1.571 });
  tool.down(editor, touch(1, 0.5));
  tool.move(editor, touch(1.3, 0.28, true));
  expect(settings()?.angle).toBe(0.785);
  expect(tool.cancel(editor)).toBe(true);
  expect(settings()?.angle).toBe(1.571);
  editor.undo();
  expect(settings()).toEqual({ place: [1, 0] });
});

test('a drag of the place keeps span and direction', () => {
  const editor = createEditor(addLayer(newShow('T', 1), layer({ place: [1, 0], size_m: 2 })));
  const tool = createLayerTool(0, 'place', cm);
  tool.down(editor, touch(1.01, 0));
  tool.move(editor, touch(0.51, 0.25));
  tool.up(editor, touch(0.51, 0.25));
  expect(layersOf(editor.state.get().show)[0]?.settings).toEqual({ place: [0.5, 0.25], size_m: 2 });
});
