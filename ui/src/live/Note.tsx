import { Button } from '@mantine/core';
import { IconAlertTriangle, IconHandStop } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useSession } from '../session/session';
import styles from './Note.module.css';

interface Props {
  /** `bad`: something failed; `stopped`: the show was stopped on purpose. */
  tone: 'bad' | 'stopped';
  text: string;
  /** Buttons for what the user can do next. */
  children: ReactNode;
}

/** A note about what became of the show, with buttons for what to do next. */
export function Note({ tone, text, children }: Props) {
  const Icon = tone === 'bad' ? IconAlertTriangle : IconHandStop;
  return (
    <div
      className={styles.note}
      data-tone={tone}
      role={tone === 'bad' ? 'alert' : 'status'}
      data-testid={`${tone}-note`}
    >
      <Icon size={20} aria-hidden />
      <strong>{text}</strong>
      {children}
    </div>
  );
}

/** A button that dismisses the last failure or stop on every screen. */
export function GotIt() {
  const { ask } = useSession();
  return (
    <Button size="compact-sm" variant="default" onClick={() => void ask({ do: 'dismiss_failure' })}>
      Got it
    </Button>
  );
}
