import { Button } from '@mantine/core';
import { IconAlertTriangle, IconHandStop } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useSession } from '../session/session';
import styles from './Note.module.css';

interface Props {
  /** `bad`: it failed or went wrong; `stopped`: it was wanted. */
  tone: 'bad' | 'stopped';
  text: string;
  /** Buttons that lead on. */
  children: ReactNode;
}

/** What became of the show, above Play, with the ways on. */
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

/** Takes the note away on every screen. */
export function GotIt() {
  const { ask } = useSession();
  return (
    <Button size="compact-sm" variant="default" onClick={() => void ask({ do: 'dismiss_failure' })}>
      Got it
    </Button>
  );
}
