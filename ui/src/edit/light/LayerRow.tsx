import { IconCopy, IconTrash } from '@tabler/icons-react';
import type { HTMLAttributes, KeyboardEvent } from 'react';
import { capitalised } from '../../base/words';
import { titleOf } from '../../model/layerKinds';
import { framesOf, type Layer } from '../../model/layers';
import type { Show } from '../../model/show';
import { IconButton } from '../../parts/IconButton';
import { useEditing } from '../context';
import { duplicateLayer, removeLayer } from './lightActs';
import { StripCanvas } from '../../light/StripCanvas';
import styles from './Light.module.css';

interface Props {
  layer: Layer;
  index: number;
  show: Show;
  isChosen: boolean;
  onChoose: () => void;
  /** Moves the layer up by 1, or down by -1. */
  onMove: (by: 1 | -1) => void;
  /** Lets the row be dragged, and other rows be dropped on it. */
  drag: HTMLAttributes<HTMLLIElement>;
}

/** A layer in the list: a small moving picture of it, its name and when it shines. */
export function LayerRow({ layer, index, show, isChosen, onChoose, onMove, drag }: Props) {
  const editing = useEditing();
  const title = titleOf(layer);
  const press = (event: KeyboardEvent) => {
    const up = event.key === 'ArrowUp';
    if (event.altKey && (up || event.key === 'ArrowDown')) {
      event.preventDefault();
      onMove(up ? 1 : -1);
    }
    if (event.key === 'Delete') {
      event.stopPropagation();
      removeLayer(editing, index);
    }
  };
  return (
    <li className={styles.layer} data-chosen={isChosen || undefined} draggable {...drag}>
      <button
        type="button"
        className={styles.choose}
        aria-pressed={isChosen}
        aria-keyshortcuts="Alt+ArrowUp Alt+ArrowDown Delete"
        title="Alt and an arrow key move it"
        onClick={onChoose}
        onKeyDown={press}
      >
        <StripCanvas lights={editing.lights} layer={layer} stage={show.stage} />
        <span className={styles.name}>
          <b>{title}</b>
          <span className={styles.when}>{whenText(show, layer)}</span>
        </span>
      </button>
      <IconButton
        label="Duplicate"
        name={`Duplicate ${title}`}
        onClick={() => duplicateLayer(editing, index)}
      >
        <IconCopy size={15} />
      </IconButton>
      <IconButton
        label="Delete"
        name={`Delete ${title}`}
        onClick={() => removeLayer(editing, index)}
      >
        <IconTrash size={15} />
      </IconButton>
    </li>
  );
}

const PHASES = { whole: '', transition: 'drive to ', picture: 'air time of ' } as const;

/** When a layer shines, in words. */
function whenText(show: Show, layer: Layer): string {
  const { when } = layer;
  if (when.of === 'show') return 'Whole show';
  if (when.of === 'seconds') return `${when.from_s} s to ${when.to_s} s`;
  const range = framesOf(show, layer);
  if (!range) return 'A frame that is gone';
  const [first, last] = range;
  const frames = first === last ? `frame ${first + 1}` : `frames ${first + 1} to ${last + 1}`;
  return capitalised(PHASES[when.phase] + frames);
}
