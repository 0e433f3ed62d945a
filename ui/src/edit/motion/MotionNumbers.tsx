import { NumberField } from '../../parts/NumberField';

interface NumberProps {
  value: number;
  onChange: (value: number) => void;
}

export const Percent = ({ value, onChange }: NumberProps) => (
  <NumberField
    label="Size (%)"
    unit=" %"
    min={5}
    max={2000}
    digits={1}
    step={5}
    value={value * 100}
    onChange={(percent) => onChange(percent / 100)}
  />
);

export const Times = ({ value, onChange }: NumberProps) => (
  <NumberField label="Times" whole min={1} max={50} value={value} onChange={onChange} />
);
