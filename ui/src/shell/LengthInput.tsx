import { NumberInput } from '@mantine/core';
import { fromUnit, inUnit, UNITS } from '../base/units';
import { useUnit } from './preferences';

interface Props {
  /** Without the unit: that is added. */
  label: string;
  /** Metres; null: nothing stands there. */
  value: number | null;
  onChange: (metres: number) => void;
  /** Metres. */
  min?: number;
  max?: number;
  disabled?: boolean;
}

/** Changes below this are rounding, metres. */
const SAME_M = 5e-5;

/** A length in the unit of this screen. */
export function LengthInput({ label, value, onChange, min, max, disabled }: Props) {
  const unit = useUnit();
  const { name, digits, step } = UNITS[unit];
  return (
    <NumberInput
      label={`${label}, ${name}`}
      size="xs"
      step={step}
      decimalScale={digits}
      min={min === undefined ? undefined : inUnit(min, unit)}
      max={max === undefined ? undefined : inUnit(max, unit)}
      disabled={disabled}
      value={value === null ? '' : inUnit(value, unit)}
      onChange={(next) => {
        if (typeof next !== 'number') return;
        const metres = fromUnit(next, unit);
        if (min !== undefined && metres < min - SAME_M) return;
        if (max !== undefined && metres > max + SAME_M) return;
        if (value === null || Math.abs(metres - value) > SAME_M) onChange(metres);
      }}
    />
  );
}
