import { Button } from '@mantine/core';
import { IconAlertTriangle, IconCircleCheck, IconInfoCircle } from '@tabler/icons-react';
import { useState } from 'react';
import type { Incident } from '../api/types.gen';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { nameOf, withNames } from '../session/robotWords';
import { earlier, unread } from '../session/incidents';
import styles from './IncidentCards.module.css';
import { Gate } from '../parts/Gate';

/** Unread incidents as cards, the newest first; those that were read are folded away below. */
export function IncidentCards() {
  const { live } = useSession();
  const incidents = useStore(live.incidents);
  const [open, setOpen] = useState(false);
  const [news, before] = [unread(incidents), earlier(incidents)];
  if (incidents.length === 0) return null;
  return (
    <section className={styles.cards} aria-label="Incidents" tabIndex={0}>
      <div aria-live="assertive">
        {news.map((incident) => (
          <Card key={incident.id} incident={incident} />
        ))}
      </div>
      {before.length > 0 ? (
        <details open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
          <summary>{before.length} earlier</summary>
          {open ? before.map((incident) => <Card key={incident.id} incident={incident} />) : null}
        </details>
      ) : null}
    </section>
  );
}

function Card({ incident }: { incident: Incident }) {
  const { ask, live, found } = useSession();
  const rows = useStore(live.fleet, (fleet) => fleet.rows);
  const [first] = incident.robots;
  const row = rows.find(({ id }) => id === first);
  const time = new Date(incident.time_ms);
  return (
    <article
      className={styles.card}
      data-tone={incident.tone}
      data-read={incident.read || undefined}
      data-testid="incident"
    >
      <Sign incident={incident} />
      <div>
        <h3>
          {withNames(incident.title, incident.robots, rows)}{' '}
          <time dateTime={time.toISOString()}>{time.toTimeString().slice(0, 8)}</time>
        </h3>
        {incident.done ? <p>{incident.done}</p> : null}
        {incident.over ? <p>That is over.</p> : <p>{incident.advice}</p>}
        {incident.read ? null : (
          <Gate needs="operator" act="answer this">
            <div className={styles.buttons}>
              {first && row ? (
                <Button
                  size="compact-sm"
                  variant="default"
                  onClick={() => {
                    found.set({ robot: first });
                    if (row.abilities.blink && row.presence === 'active')
                      void ask({ do: 'identify', robot: first });
                  }}
                >
                  Find robot {nameOf(row)}
                </Button>
              ) : null}
              {incident.wants_to_join && !incident.over ? (
                <Button
                  size="compact-sm"
                  onClick={() => void ask({ do: 'list', robots: incident.robots, listed: true })}
                >
                  {incident.count === 1 ? 'Let it join' : `Let ${incident.robots.length} join`}
                </Button>
              ) : null}
              <Button
                size="compact-sm"
                variant="default"
                onClick={() => void ask({ do: 'read_incident', incident: incident.id })}
              >
                Got it
              </Button>
            </div>
          </Gate>
        )}
      </div>
    </article>
  );
}

function Sign({ incident }: { incident: Incident }) {
  if (incident.over) return <IconCircleCheck size={20} role="img" aria-label="Over" />;
  if (incident.tone === 'information')
    return <IconInfoCircle size={20} role="img" aria-label="Information" />;
  const label = incident.tone === 'failed' ? 'Failed' : 'Look';
  return <IconAlertTriangle size={20} role="img" aria-label={label} />;
}
