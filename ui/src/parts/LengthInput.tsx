import { fromUnit, inUnit, UNITS } from '../base/units';
import { NumberField } from './NumberField';
import { useUnit } from '../session/preferences';

interface Props {
  /** Label without the unit, which is added. */
  label: string;
  /** Metres; null: an empty field. */
  value: number | null;
  onChange: (metres: number) => void;
  /** Least value, metres; by default -1000. `max` in the same way, by default 1000. */
  min?: number;
  max?: number;
  disabled?: boolean;
}

/** Largest coordinate of the protocol, metres. */
const FAR_M = 1000;

/** A field for a length, shown in the unit of this screen. */
export function LengthInput({
  label,
  value,
  onChange,
  min = -FAR_M,
  max = FAR_M,
  disabled,
}: Props) {
  const unit = useUnit();
  const { name, digits, step } = UNITS[unit];
  return (
    <NumberField
      label={`${label}, ${name}`}
      unit={` ${unit}`}
      step={step}
      digits={digits}
      min={inUnit(min, unit)}
      max={inUnit(max, unit)}
      disabled={disabled}
      value={value === null ? null : inUnit(value, unit)}
      onChange={(next) => onChange(fromUnit(next, unit))}
    />
  );
}
