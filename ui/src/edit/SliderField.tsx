import { Button, Slider, Text } from '@mantine/core';
import styles from './Make.module.css';

interface Props {
  label: string;
  /** The value with its unit. */
  text: string;
  value: number;
  min: number;
  max: number;
  step: number;
  /** Goes back to the automatic value; absent: the value is automatic already, or there is no automatic one. */
  onAuto?: () => void;
  onChange: (value: number) => void;
  /** The thumb was let go. */
  onChangeEnd?: (value: number) => void;
}

/** A slider with its label and its value above. */
export function SliderField({ label, text, onAuto, value, min, max, ...slider }: Props) {
  return (
    <div>
      <div className={styles.line}>
        <Text size="xs" fw={600}>
          {label}
        </Text>
        <Text size="xs" c="dimmed" component="span">
          {text}
          {onAuto ? (
            <Button size="compact-xs" variant="subtle" color="gray" ml={4} onClick={onAuto}>
              Automatic
            </Button>
          ) : null}
        </Text>
      </div>
      <Slider
        size="sm"
        label={null}
        thumbLabel={label}
        thumbProps={{ 'aria-valuetext': text }}
        value={Math.min(max, Math.max(min, value))}
        {...{ min, max }}
        {...slider}
      />
    </div>
  );
}
