import { useRef } from 'react';
import styles from './NameField.module.css';

interface Props {
  label: string;
  name: string;
  /** The typed name; null: cancelled. `isByKey`: Enter or Escape ended it, so that no other element has the focus. */
  onName: (name: string | null, isByKey: boolean) => void;
}

/** A name that is typed where it is shown. Enter and leaving the field take it, Escape cancels. */
export function NameField({ label, name, onName }: Props) {
  // Whether the name was taken or cancelled: the field loses the focus afterwards, which must not take it again.
  const left = useRef(false);
  const leave = (typed: string | null, isByKey: boolean) => {
    if (left.current) return;
    left.current = true;
    onName(typed?.trim() ?? null, isByKey);
  };
  return (
    <input
      className={styles.name}
      aria-label={label}
      autoFocus
      maxLength={80}
      defaultValue={name}
      onFocus={(event) => event.currentTarget.select()}
      onBlur={(event) => leave(event.currentTarget.value, false)}
      onKeyDown={(event) => {
        if (event.key === 'Enter') leave(event.currentTarget.value, true);
        if (event.key === 'Escape') leave(null, true);
      }}
    />
  );
}
