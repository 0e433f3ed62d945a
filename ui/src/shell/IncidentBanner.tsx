import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { holding } from '../session/incidents';
import { goTo, type View } from '../session/address';
import { useSession } from '../session/session';
import styles from './IncidentBanner.module.css';

/** The newest unread incident that still holds, unless it is mere information; hidden where the live view shows it. */
export function IncidentBanner({ view }: { view: View }) {
  const { live, ask } = useSession();
  const news = holding(useStore(live.incidents));
  const [first] = news;
  if (!first || first.tone === 'information') return null;
  const more = news.length - 1;
  return (
    <div
      className={`banner ${styles.banner}`}
      data-beside={view === 'live' || undefined}
      data-testid="incident-banner"
    >
      <strong>{first.title}</strong>
      {more > 0 ? ` ${more} more.` : null}{' '}
      {view === 'live' ? null : (
        <Button size="compact-xs" variant="default" onClick={() => goTo('live')}>
          Look
        </Button>
      )}{' '}
      <Button
        size="compact-xs"
        variant="default"
        onClick={() => void ask({ do: 'read_incident', incident: first.id })}
      >
        Got it
      </Button>
    </div>
  );
}
