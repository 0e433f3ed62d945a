import { useId, type ReactNode } from 'react';
import { useStore } from '../base/store';
import { whyNot, type Role } from '../session/roles';
import { useSession } from '../session/session';
import styles from './Gate.module.css';

interface Props {
  /** The least role that may use the controls. */
  needs: Role;
  /** What the controls do, to follow "An operator can". */
  act: string;
  children: ReactNode;
}

/** Why the role of this person is not enough for something; null: it is enough. */
export function useWhyNot(needs: Role, act: string): string | null {
  return whyNot(useStore(useSession().role), needs, act);
}

/** Disables the controls inside, and says why, where the role of this person is not enough for them. */
export function Gate({ needs, act, children }: Props) {
  const reason = useWhyNot(needs, act);
  const id = useId();
  return (
    <fieldset
      className={styles.gate}
      disabled={reason !== null}
      title={reason ?? undefined}
      aria-describedby={reason === null ? undefined : id}
    >
      {children}
      {reason === null ? null : (
        <span id={id} className="hidden-text">
          {reason}
        </span>
      )}
    </fieldset>
  );
}
