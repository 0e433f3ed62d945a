import { shortSeconds } from '../../base/time';
import { layersOf } from '../../model/layers';
import { titleOf } from '../../model/layerKinds';
import type { Show } from '../../model/show';
import { blocksOf, type Block } from '../../model/timelineBlocks';
import { layerBar, moveLayerPart, stepLayerPart, type LayerPart } from '../../model/timelineLayers';
import type { Editing } from '../editing';
import { removeLayer } from '../light/lightActs';
import type { PointerDrag } from './followPointer';
import { blocksNow, dragOf } from './timelineDrag';
import type { TimelineView } from './timelineView';

/** A layer with the time in which it shines, as text for people; empty: there is no such layer. */
export function layerText(show: Show, blocks: readonly Block[], index: number): string {
  const layer = layersOf(show)[index];
  if (!layer) return '';
  const bar = layerBar(show, blocks, layer);
  const when =
    layer.when.of === 'show'
      ? 'over the whole show'
      : bar
        ? `from ${shortSeconds(bar.from_s)} s to ${shortSeconds(bar.to_s)} s`
        : 'in frames that are gone';
  return `Layer ${titleOf(layer)} ${when}`;
}

const sayLayer = (editing: Editing, view: TimelineView, index: number) =>
  view.status.set(layerText(editing.editor.state.get().show, blocksNow(editing, view), index));

export function dragLayer(
  editing: Editing,
  view: TimelineView,
  index: number,
  part: LayerPart,
): PointerDrag | null {
  const { show } = editing.editor.state.get();
  const layer = layersOf(show)[index];
  const bar = layer && layerBar(show, blocksNow(editing, view), layer);
  if (!bar?.hasEnds) return null;
  return dragOf(
    editing,
    view,
    'When light shines',
    { what: 'layer', index },
    part === 'to' ? bar.to_s : bar.from_s,
    (begun, blocks, to_s) => moveLayerPart(begun, blocks, index, part, to_s),
    () => sayLayer(editing, view, index),
  );
}

export function stepLayer(
  editing: Editing,
  view: TimelineView,
  index: number,
  part: LayerPart,
  by_s: number,
) {
  editing.editor.change('When light shines', (show) =>
    stepLayerPart(show, blocksOf(show, view.drives.get()), index, part, by_s),
  );
  sayLayer(editing, view, index);
}

export function deleteLayer(editing: Editing, view: TimelineView, index: number) {
  removeLayer(editing, index);
  view.status.set('Layer deleted');
}
