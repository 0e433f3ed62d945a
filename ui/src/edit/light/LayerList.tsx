import { useCallback, useEffect, useRef, useState } from 'react';
import type { Layer } from '../../model/layers';
import { useEditing, useEditor } from '../context';
import { listenToHold } from '../holdDrag';
import { LayerRow } from './LayerRow';
import { moveLayer } from './lightActs';
import styles from './Light.module.css';

/** All layers, the uppermost first: choose, drag to another place, delete. */
export function LayerList({ layers, chosen }: { layers: readonly Layer[]; chosen: number | null }) {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const list = useRef<HTMLUListElement>(null);
  const dragged = useRef<number | null>(null);
  const [over, setOver] = useState<number | null>(null);
  const count = layers.length;
  const drop = useCallback(
    (row: number) => {
      const from = dragged.current;
      dragged.current = null;
      setOver(null);
      if (from !== null && from !== row) moveLayer(editing, count - 1 - from, count - 1 - row);
    },
    [editing, count],
  );
  useEffect(
    () =>
      list.current
        ? listenToHold(list.current, {
            begin: (row) => setOver((dragged.current = row)),
            over: setOver,
            drop,
            giveUp: () => setOver((dragged.current = null)),
          })
        : undefined,
    [drop],
  );
  return (
    <ul className={styles.layers} aria-label="Layers, the uppermost first" ref={list}>
      {layers.map((_, row) => {
        const index = count - 1 - row;
        const layer = layers[index];
        return layer ? (
          <LayerRow
            key={index}
            layer={layer}
            show={show}
            isChosen={index === chosen}
            isOver={over === row}
            onChoose={() => editing.layer.set(index === chosen ? null : index)}
            onMove={(by) => moveLayer(editing, index, index + by)}
            index={index}
            drag={{
              begin: () => (dragged.current = row),
              over: () => {
                if (dragged.current !== null) setOver(row);
              },
              isOn: () => dragged.current !== null,
              drop: () => drop(row),
              end: () => setOver((dragged.current = null)),
            }}
          />
        ) : null;
      })}
    </ul>
  );
}
