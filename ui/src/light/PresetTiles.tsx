import { useMemo } from 'react';
import { LIGHT_PRESETS, presetLayer } from '../model/lightPresets';
import type { Stage } from '../model/show';
import type { Lights } from './lights';
import { StripCanvas } from './StripCanvas';
import styles from './presets.module.css';

interface Props {
  label: string;
  lights: Lights;
  stage: Stage;
  onPress: (index: number) => void;
  /** Whether the preset with that title is on; absent where presets cannot be on. */
  isOn?: (title: string) => boolean;
  /** The key on the keyboard for the preset with that index. */
  keyOf?: (index: number) => string | undefined;
  disabled?: boolean;
}

/** All presets as buttons, each as it would look on this floor. */
export function PresetTiles(props: Props) {
  const { label, lights, stage, onPress, isOn, keyOf, disabled } = props;
  const layers = useMemo(() => LIGHT_PRESETS.map((one) => presetLayer(one, stage)), [stage]);
  return (
    <ul className={styles.presets} aria-label={label}>
      {LIGHT_PRESETS.map(({ title }, i) => (
        <li key={title}>
          <button
            type="button"
            className={styles.preset}
            aria-pressed={isOn?.(title)}
            aria-keyshortcuts={keyOf?.(i)}
            disabled={disabled}
            onClick={() => onPress(i)}
          >
            {layers[i] ? <StripCanvas lights={lights} layer={layers[i]} stage={stage} /> : null}
            <span className={styles.title}>
              {title}
              {keyOf ? <kbd aria-hidden>{keyOf(i)?.toUpperCase()}</kbd> : null}
            </span>
          </button>
        </li>
      ))}
    </ul>
  );
}
