import { TextInput, UnstyledButton } from '@mantine/core';
import { IconChevronDown, IconChevronUp } from '@tabler/icons-react';
import { useState, type KeyboardEvent } from 'react';
import { readNumber, stepped, type NumberRule } from '../base/numbers';
import styles from './NumberField.module.css';

interface Props extends NumberRule {
  label: string;
  description?: string;
  /** The present value; null: an empty field. */
  value: number | null;
  /** Most decimals shown; 0 by default. */
  digits?: number;
  /** Step of the arrows; 1 by default. */
  step?: number;
  disabled?: boolean;
  onChange: (value: number) => void;
}

/**
 * A field for a number. The value changes with Enter, by a step, or when the field loses the focus. Text that is no
 * number within the limits stays in the field with the reason, and the value stays; Escape shows the value again.
 */
export function NumberField(props: Props) {
  const { label, description, value, digits = 0, step = 1, disabled, onChange } = props;
  const shown = value === null ? '' : String(Number(value.toFixed(digits)));
  const [typed, setTyped] = useState<{ text: string; over: string } | null>(null);
  // A value that changes from outside, such as for another pixel, replaces the typed text.
  const text = typed?.over === shown ? typed.text : null;
  const read = text === null || text === shown ? null : readNumber(text, props);
  const take = () => {
    if (read?.ok === false) return;
    setTyped(null);
    if (read?.ok && read.value !== Number(shown)) onChange(read.value);
  };
  const move = (up: boolean) => {
    const from = read?.ok ? read.value : Number(shown);
    setTyped(null);
    const next = stepped(from, step, up, props);
    if (next !== Number(shown)) onChange(next);
  };
  const press = (event: KeyboardEvent) => {
    if (event.key === 'Enter') take();
    if (event.key === 'Escape') setTyped(null);
    if (event.key !== 'ArrowUp' && event.key !== 'ArrowDown') return;
    event.preventDefault();
    move(event.key === 'ArrowUp');
  };
  const kept = shown === '' ? '' : ` It is still ${shown}${props.unit ?? ''}.`;
  return (
    <TextInput
      className={styles.field}
      style={{ flex: 1 }}
      label={label}
      description={description}
      size="xs"
      inputMode={props.whole ? 'numeric' : 'decimal'}
      autoComplete="off"
      disabled={disabled}
      value={text ?? shown}
      error={read?.ok === false ? `${read.problem}.${kept}` : undefined}
      errorProps={{ role: 'alert' }}
      onChange={(event) => setTyped({ text: event.currentTarget.value, over: shown })}
      onBlur={take}
      onKeyDown={press}
      rightSectionWidth={20}
      rightSection={disabled ? null : <Steps onStep={move} />}
    />
  );
}

/** Arrows for the pointer; on the keyboard, the arrow keys of the field do the same. */
function Steps({ onStep }: { onStep: (up: boolean) => void }) {
  const arrow = (up: boolean) => (
    <UnstyledButton
      tabIndex={-1}
      aria-hidden
      // The field keeps the focus: leaving it would take the typed number before the step.
      onMouseDown={(event) => event.preventDefault()}
      onClick={() => onStep(up)}
    >
      {up ? <IconChevronUp size={12} /> : <IconChevronDown size={12} />}
    </UnstyledButton>
  );
  return (
    <span className={styles.steps}>
      {arrow(true)}
      {arrow(false)}
    </span>
  );
}
