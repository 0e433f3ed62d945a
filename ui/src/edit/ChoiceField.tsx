import { SegmentedControl, Text } from '@mantine/core';

interface Props<T extends string> {
  label: string;
  value: T;
  /** What can be chosen, in this order. */
  values: readonly T[];
  labels: Readonly<Record<T, string>>;
  onChange: (value: T) => void;
}

/** One of a few choices, side by side, with a label above. */
export function ChoiceField<T extends string>(props: Props<T>) {
  const { label, value, values, labels, onChange } = props;
  return (
    <div>
      <Text size="xs" fw={600} mb={4}>
        {label}
      </Text>
      <SegmentedControl
        aria-label={label}
        size="xs"
        fullWidth
        value={value}
        onChange={(next) => onChange(next as T)}
        data={values.map((one) => ({ value: one, label: labels[one] }))}
      />
    </div>
  );
}
