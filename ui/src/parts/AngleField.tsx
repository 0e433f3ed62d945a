import { NumberField } from './NumberField';

interface Props {
  /** Label without the unit, which is added. */
  label: string;
  /** Radians. */
  value: number;
  /** Largest angle in either direction, degrees. */
  most: number;
  onChange: (radians: number) => void;
}

/** A field for an angle, shown in degrees. */
export function AngleField({ label, value, most, onChange }: Props) {
  return (
    <NumberField
      label={`${label} (°)`}
      unit="°"
      min={-most}
      max={most}
      digits={1}
      step={15}
      value={(value * 180) / Math.PI}
      onChange={(degrees) => onChange((degrees * Math.PI) / 180)}
    />
  );
}
