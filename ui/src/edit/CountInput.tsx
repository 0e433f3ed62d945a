import { NumberInput } from '@mantine/core';
import { useState } from 'react';

interface Props {
  label: string;
  value: number;
  max: number;
  onChange: (count: number) => void;
}

/**
 * A whole number from 1 on. It counts once it is typed to its end: on the way to 45 it is 4, which would cost pixels.
 */
export function CountInput({ label, value, max, onChange }: Props) {
  const [typed, setTyped] = useState<number | string | null>(null);
  const take = (count: number | string | null | undefined) => {
    setTyped(null);
    if (typeof count !== 'number' || !Number.isFinite(count)) return;
    const wanted = Math.max(1, Math.min(max, Math.round(count)));
    if (wanted !== value) onChange(wanted);
  };
  return (
    <NumberInput
      style={{ flex: 1 }}
      label={label}
      size="xs"
      min={1}
      max={max}
      clampBehavior="none"
      allowDecimal={false}
      allowNegative={false}
      value={typed ?? value}
      onChange={setTyped}
      onValueChange={({ floatValue }, { source }) => {
        const isStep = (source as string) === 'increment' || (source as string) === 'decrement';
        if (isStep) take(floatValue);
      }}
      onBlur={() => take(typed)}
      onKeyDown={(event) => {
        if (event.key === 'Enter') take(typed);
      }}
    />
  );
}
