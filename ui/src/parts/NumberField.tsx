import { TextInput, UnstyledButton } from '@mantine/core';
import { IconChevronDown, IconChevronUp } from '@tabler/icons-react';
import { useState, type KeyboardEvent } from 'react';
import { readNumber, stepped, type NumberRule } from '../base/numbers';
import styles from './NumberField.module.css';

interface Props extends NumberRule {
  label: string;
  description?: string;
  /** null: an empty field. */
  value: number | null;
  /** Most decimals shown. */
  digits?: number;
  /** Step of the arrows. */
  step?: number;
  disabled?: boolean;
  onChange: (value: number) => void;
}

/**
 * A field for a number. The value changes with Enter, with an arrow key, or when the field loses the focus.
 * What cannot be taken stays in the field with the reason, and the value stays what it was; Escape brings it back.
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

/** Arrows for the pointer; the keyboard has its own keys. */
function Steps({ onStep }: { onStep: (up: boolean) => void }) {
  const arrow = (up: boolean) => (
    <UnstyledButton
      tabIndex={-1}
      aria-hidden
      // The field keeps the focus, because the step starts from the typed number.
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
