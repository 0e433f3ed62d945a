import { Tooltip } from '@mantine/core';
import type { ReactNode } from 'react';
import { useStore } from '../base/store';
import { fleetKind, KIND_WORDS, kindHint } from '../session/fleetKind';
import { useSession } from '../session/session';
import pill from '../parts/Pill.module.css';
import styles from './Pills.module.css';

type Tone = 'good' | 'warn' | 'bad' | 'quiet';

function Pill(props: { tone: Tone; hint: string; children: ReactNode; label: string }) {
  return (
    <Tooltip label={props.hint}>
      <span className={pill.pill} data-tone={props.tone} role="status" aria-label={props.label}>
        <i aria-hidden />
        {props.children}
      </span>
    </Tooltip>
  );
}

/** State of the connections to server and broker, in a few words. */
export function LinkPill() {
  const { live } = useSession();
  const link = useStore(live.link);
  const broker = useStore(live.broker);
  if (link !== 'open') {
    const text = link === 'lost' ? 'Server offline' : 'Connecting';
    return (
      <Pill
        tone={link === 'lost' ? 'bad' : 'warn'}
        hint="The page connects by itself."
        label={text}
      >
        {text}
      </Pill>
    );
  }
  const hint = broker.connected ? `Broker: ${broker.address}` : (broker.reason ?? 'No broker');
  return (
    <Pill
      tone={broker.connected ? 'good' : 'bad'}
      hint={hint}
      label={broker.connected ? 'Broker connected' : 'No broker'}
    >
      {broker.connected ? 'Connected' : 'No broker'}
    </Pill>
  );
}

/** Whether the robots are simulated or real; nothing without robots. */
export function KindPill() {
  const { live } = useSession();
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const kind = fleetKind(rows);
  if (kind === null) return null;
  return (
    <Tooltip label={kindHint(rows)}>
      <span className={styles.kind} data-kind={kind} data-testid="kind" role="status">
        {KIND_WORDS[kind]}
      </span>
    </Tooltip>
  );
}

/** Number of robots that report now, and of all robots if some are silent. */
export function FleetPill() {
  const { live } = useSession();
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const active = rows.filter((row) => row.presence === 'active').length;
  const troubled = rows.filter((row) => ['lost', 'cut', 'faulty'].includes(row.status)).length;
  const silent = rows.length - active;
  const tone: Tone = rows.length === 0 ? 'quiet' : troubled > 0 || silent > 0 ? 'warn' : 'good';
  const hint =
    rows.length === 0
      ? 'No robot has introduced itself yet.'
      : `${active} here, ${silent} silent, ${troubled} in trouble`;
  return (
    <Pill tone={tone} hint={hint} label={`Robots: ${hint}`}>
      {active === rows.length ? active : `${active} of ${rows.length}`} robots
    </Pill>
  );
}
