import { Badge, Tabs } from '@mantine/core';
import { lazy, Suspense, useState } from 'react';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { CueList } from './CueList';
import { FleetTable } from './FleetTable';
import { IncidentCards } from './IncidentCards';
import type { useLiveLight } from './light/useLiveLight';
import { LogList } from './LogList';
import { ShowFacts } from './ShowFacts';
import styles from '../parts/page.module.css';

const LightTab = lazy(() => import('./light/LightTab'));

interface Props {
  liveLight: ReturnType<typeof useLiveLight>;
  /** Opens the dialog of past runs. */
  onPast: () => void;
}

/** The side of the live view: incidents, and tabs with robots, cues, light, show and log. */
export function FleetSide({ liveLight, onPast }: Props) {
  const { live } = useSession();
  const [wide, setWide] = useState(false);
  const [tab, setTab] = useState<string | null>('robots');
  const lights = useStore(live.playback, (p) => p.live_light.length);
  const robots = useStore(live.fleet, (fleet) => fleet.rows.length);
  const issues = useStore(
    live.plan,
    (plan) => plan?.issues.filter((i) => i.severity !== 'note').length ?? 0,
  );
  return (
    <aside
      className={styles.side}
      aria-label="Fleet, cues, light, show and log"
      data-wide={(wide && tab === 'robots') || undefined}
    >
      <IncidentCards />
      <Tabs value={tab} onChange={setTab}>
        <Tabs.List grow>
          <Tabs.Tab value="robots">
            Robots {robots > 0 ? <span className="quiet">{robots}</span> : null}
          </Tabs.Tab>
          <Tabs.Tab value="cues">Cues</Tabs.Tab>
          <Tabs.Tab value="light">
            Light {lights > 0 ? <span className="quiet">{lights}</span> : null}
          </Tabs.Tab>
          <Tabs.Tab
            value="show"
            rightSection={
              issues > 0 ? (
                <Badge size="xs" circle color="care">
                  {issues}
                  <span className="hidden-text"> problems</span>
                </Badge>
              ) : null
            }
          >
            Show
          </Tabs.Tab>
          <Tabs.Tab value="log">Log</Tabs.Tab>
        </Tabs.List>
        <Tabs.Panel value="robots">
          <FleetTable wide={wide} onWide={setWide} />
        </Tabs.Panel>
        <Tabs.Panel value="cues">
          <CueList />
        </Tabs.Panel>
        <Tabs.Panel value="light">
          {tab === 'light' ? (
            <Suspense>
              <LightTab {...liveLight} />
            </Suspense>
          ) : null}
        </Tabs.Panel>
        <Tabs.Panel value="show" p="md">
          <ShowFacts />
        </Tabs.Panel>
        <Tabs.Panel value="log">
          <LogList seen={tab === 'log'} onPast={onPast} />
        </Tabs.Panel>
      </Tabs>
    </aside>
  );
}
