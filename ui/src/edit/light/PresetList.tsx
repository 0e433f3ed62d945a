import { useMemo } from 'react';
import { LIGHT_PRESETS, presetLayer } from '../../model/lightPresets';
import { useEditing, useEditor } from '../context';
import { addPreset } from './lightActs';
import { StripCanvas } from './StripCanvas';
import styles from './Light.module.css';

/** Presets, each as it would look on this floor; one press adds it over the whole show. */
export function PresetList({ onAdded }: { onAdded: () => void }) {
  const editing = useEditing();
  const stage = useEditor((s) => s.show.stage);
  const layers = useMemo(() => LIGHT_PRESETS.map((one) => presetLayer(one, stage)), [stage]);
  return (
    <ul className={styles.presets} aria-label="Presets of light">
      {LIGHT_PRESETS.map((preset, i) => (
        <li key={preset.title}>
          <button
            type="button"
            className={styles.preset}
            onClick={() => {
              addPreset(editing, preset);
              onAdded();
            }}
          >
            {layers[i] ? <StripCanvas layer={layers[i]} stage={stage} /> : null}
            {preset.title}
          </button>
        </li>
      ))}
    </ul>
  );
}
