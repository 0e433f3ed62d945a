import { IconBulb } from '@tabler/icons-react';
import { type KeyboardEvent, type PointerEvent } from 'react';
import { useStore } from '../../base/store';
import { titleOf } from '../../model/layerKinds';
import { layersOf } from '../../model/layers';
import { xOf } from '../../model/timelineAxis';
import { layerBar, type LayerPart } from '../../model/timelineLayers';
import { useEditing } from '../context';
import { edgeKey, takeKey } from './edgeKeys';
import { followPointer } from './followPointer';
import { deleteLayer, dragLayer, layerText, stepLayer } from './layerActs';
import { LayerTrack } from './LayerTrack';
import { layerPaint } from './paint';
import { layerHeight, revealRow, useTimelineView, type TrackProps } from './timelineView';
import styles from './Timeline.module.css';

/** The layers of light, the uppermost first, each with a bar from the begin to the end of its time. */
export function LayerRows({ show, blocks, axis, drawn }: TrackProps) {
  const editing = useEditing();
  const view = useTimelineView();
  const chosen = useStore(editing.layer);
  const layers = layersOf(show);
  const height = layerHeight();
  const choose = (index: number) => {
    const nearest = Math.max(0, Math.min(layers.length - 1, index));
    editing.layer.set(nearest);
    view.status.set(layerText(show, blocks, nearest));
    revealRow(view, layers.length - 1 - nearest);
  };
  const press = (event: KeyboardEvent) => {
    const edge = edgeKey(event);
    const at = chosen ?? layers.length;
    if (edge && chosen !== null)
      stepLayer(editing, view, chosen, edge.isEnd ? 'to' : 'from', edge.by_s);
    else if (event.ctrlKey || event.metaKey || event.altKey) return;
    else if (event.key === 'ArrowUp') choose(at + 1);
    else if (event.key === 'ArrowDown') choose(at - 1);
    else if (event.key === 'Delete' && chosen !== null) deleteLayer(editing, view, chosen);
    else return;
    takeKey(event);
  };
  const down = (event: PointerEvent) => {
    const target = event.target as HTMLElement;
    const row = target.closest<HTMLElement>('[data-layer]');
    if (!row || event.button !== 0) return;
    const index = Number(row.dataset.layer);
    editing.layer.set(index);
    view.status.set(layerText(show, blocks, index));
    const part = target.closest<HTMLElement>('[data-part]')?.dataset.part as LayerPart | undefined;
    // A finger in the middle of a bar scrolls the timeline; on an end of it, it drags the end.
    if (!part || (part === 'whole' && event.pointerType === 'touch')) return;
    const drag = dragLayer(editing, view, index, part);
    if (drag) followPointer(event, view.scroller, drag);
  };
  if (layers.length === 0) return null;
  return (
    <div
      role="listbox"
      tabIndex={0}
      className={styles.layerList}
      style={{ height: layers.length * height }}
      aria-label="Layers of light on the timeline"
      aria-activedescendant={chosen === null ? undefined : idOf(chosen)}
      onPointerDown={down}
      onKeyDown={press}
    >
      {layers.map((layer, index) => {
        const row = layers.length - 1 - index;
        // The chosen layer is there even out of sight, because the list box names it as active.
        const isDrawn = row >= drawn.fromRow && row < drawn.toRow;
        if (!isDrawn && index !== chosen) return null;
        const bar = layerBar(show, blocks, layer);
        return (
          <LayerTrack
            key={index}
            id={idOf(index)}
            index={index}
            top={row * height}
            title={titleOf(layer)}
            label={layerText(show, blocks, index)}
            left={bar ? xOf(axis, bar.from_s) : null}
            width={bar ? (bar.to_s - bar.from_s) * axis.scale : 0}
            hasEnds={bar?.hasEnds ?? false}
            paint={layerPaint(layer)}
            isChosen={index === chosen}
          />
        );
      })}
    </div>
  );
}

/** The names of the layers, which stay at the left; hidden from screen readers, which get them from the list. */
export function LayerNames({ show, drawn }: Pick<TrackProps, 'show' | 'drawn'>) {
  const editing = useEditing();
  const chosen = useStore(editing.layer);
  const layers = layersOf(show);
  const height = layerHeight();
  return (
    <div className={styles.names} style={{ height: layers.length * height }} aria-hidden>
      {layers.map((layer, index) => {
        const row = layers.length - 1 - index;
        if (row < drawn.fromRow || row >= drawn.toRow) return null;
        return (
          <div
            key={index}
            className={styles.name}
            data-height="layer"
            data-chosen={index === chosen || undefined}
            style={{ top: row * height }}
            title={titleOf(layer)}
            onClick={() => editing.layer.set(index)}
          >
            <IconBulb size={15} />
            <span>{titleOf(layer)}</span>
          </div>
        );
      })}
    </div>
  );
}

const idOf = (index: number) => `timeline-layer-${index}`;
