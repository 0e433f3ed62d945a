import { presetLayer, type LightPreset } from '../../model/lightPresets';
import * as layers from '../../model/layers';
import type { Editing } from '../editing';

/** Adds a preset over all layers, and chooses it. */
export function addPreset({ editor, layer }: Editing, preset: LightPreset) {
  editor.change(`Light: ${preset.title}`, (show) =>
    layers.addLayer(show, presetLayer(preset, show.stage)),
  );
  layer.set(layers.layersOf(editor.state.get().show).length - 1);
}

export function removeLayer({ editor, layer }: Editing, index: number) {
  editor.change('Delete light', (show) => layers.removeLayer(show, index));
  layer.update((now) => (now === null || now < index ? now : now === index ? null : now - 1));
}

/** Puts a copy over a layer, and chooses it. */
export function duplicateLayer({ editor, layer }: Editing, index: number) {
  editor.change('Duplicate light', (show) => layers.duplicateLayer(show, index));
  layer.set(index + 1);
}

/** Moves a layer to index `to`; the layer that is chosen stays chosen. */
export function moveLayer({ editor, layer }: Editing, index: number, to: number) {
  const before = editor.state.get().show;
  editor.change('Order of light', (show) => layers.moveLayer(show, index, to));
  if (editor.state.get().show === before) return;
  layer.update((chosen) => (chosen === null ? null : followed(chosen, index, to)));
}

/** The new index of the layer at `number` after a layer was moved from index `from` to `to`. */
function followed(number: number, from: number, to: number): number {
  if (number === from) return to;
  if (from < number && to >= number) return number - 1;
  return from > number && to <= number ? number + 1 : number;
}

/** Changes settings of a layer. */
export function setSettings({ editor }: Editing, index: number, settings: layers.LayerSettings) {
  editor.change('Light', (show) => layers.setLayerSettings(show, index, settings));
}

export function setFields(
  { editor }: Editing,
  index: number,
  fields: Parameters<typeof layers.setLayer>[2],
) {
  editor.change('Light', (show) => layers.setLayer(show, index, fields));
}

/** Lets a layer shine in a part of its frames; a layer without frames gets those from the first to the last chosen. */
export function setPhase({ editor }: Editing, index: number, phase: layers.LayerPhase) {
  editor.change('When light shines', (show, state) => {
    const layer = layers.layersOf(show)[index];
    const range = layer && layers.framesOf(show, layer);
    const chosen = [...state.frames];
    return layers.setLayerFrames(
      show,
      index,
      range ?? [Math.min(...chosen), Math.max(...chosen)],
      phase,
    );
  });
}

export function setFrames(
  { editor }: Editing,
  index: number,
  range: readonly [number, number],
  phase: layers.LayerPhase,
) {
  editor.change('When light shines', (show) => layers.setLayerFrames(show, index, range, phase));
}
