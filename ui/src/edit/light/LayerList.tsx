import { useCallback } from 'react';
import type { Layer } from '../../model/layers';
import { useEditing, useEditor } from '../context';
import { useReorder } from '../useReorder';
import { LayerRow } from './LayerRow';
import { moveLayer } from './lightActs';
import styles from './Light.module.css';

/** All layers, the uppermost first: choose, drag to another place, delete. */
export function LayerList({ layers, chosen }: { layers: readonly Layer[]; chosen: number | null }) {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const last = layers.length - 1;
  const drop = useCallback(
    (from: number, to: number) => moveLayer(editing, last - from, last - to),
    [editing, last],
  );
  const { list, begin, end, target } = useReorder(drop);
  return (
    <ul className={styles.layers} aria-label="Layers, the uppermost first" ref={list}>
      {[...layers].reverse().map((layer, row) => {
        const index = last - row;
        return (
          <LayerRow
            key={index}
            layer={layer}
            index={index}
            show={show}
            isChosen={index === chosen}
            onChoose={() => editing.layer.set(index === chosen ? null : index)}
            onMove={(by) => moveLayer(editing, index, index + by)}
            drag={{ ...target(row), onDragStart: () => begin(row), onDragEnd: end }}
          />
        );
      })}
    </ul>
  );
}
