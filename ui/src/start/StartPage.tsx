import { Title } from '@mantine/core';
import { useMemo, useState } from 'react';
import { useStore } from '../base/store';
import { countText } from '../base/numbers';
import { sizeText } from '../base/units';
import { floorFor } from '../make/templateShow';
import { TEMPLATES } from '../make/templates';
import { ROBOTS_DEFAULT } from '../session/createShow';
import { useUnit } from '../session/preferences';
import { useSession } from '../session/session';
import { AskBox } from './AskBox';
import { beginWith, type Fleet } from './begin';
import { RecentShows } from './RecentShows';
import { TemplateCard } from './TemplateCard';
import { useFaces } from './useFaces';
import { useMaker } from './useMaker';
import { PastRuns } from './PastRuns';
import { Playlist } from './Playlist';
import { YourFleet } from './YourFleet';
import styles from './Start.module.css';

/** The page that begins a new show: from words, files, a template, or empty. Also recent shows, playlist and fleet. */
export default function StartPage() {
  const session = useSession();
  const maker = useMaker();
  const here = useStore(session.live.fleet, (fleet) => fleet.rows.length);
  const unit = useUnit();
  const fleet: Fleet = useMemo(() => {
    const robots = here || ROBOTS_DEFAULT;
    return { robots, stage: floorFor(robots) };
  }, [here]);
  const faces = useFaces(fleet);
  const [busy, setBusy] = useState<{ id: string; made: number } | null>(null);
  const begin = async (id: string, title: string, frames: Parameters<typeof beginWith>[4]) => {
    if (busy) return;
    setBusy({ id, made: 0 });
    await beginWith(session, maker, fleet, title, frames, (made) => setBusy({ id, made }));
    setBusy(null);
  };
  const { stage, robots } = fleet;
  const floor = `${sizeText(stage.width_m, unit)} × ${sizeText(stage.depth_m, unit)}`;
  const pixels = countText(robots, 'robot');
  return (
    <main className={styles.page}>
      <div className={styles.inside}>
        <AskBox
          fleet={fleet}
          about={`${pixels} · ${floor}`}
          isBusy={busy !== null}
          onWords={(text, frames) => void begin('words', text, frames)}
        />
        <section aria-labelledby="templates">
          <div className={styles.head}>
            <Title order={2} size="h4" id="templates">
              Start from a template
            </Title>
            <span className="quiet">
              For {pixels} on {floor}
            </span>
          </div>
          <ul className={styles.cards}>
            {TEMPLATES.map((template) => (
              <TemplateCard
                key={template.id}
                template={template}
                fleet={fleet}
                face={faces.get(template.id) ?? null}
                made={busy?.id === template.id ? busy.made : null}
                isBusy={busy !== null}
                onChoose={(frames) => void begin(template.id, template.title, frames)}
              />
            ))}
          </ul>
        </section>
        <aside className={styles.aside}>
          <RecentShows />
          <Playlist />
          <PastRuns />
          <YourFleet floor={floor} here={here} />
        </aside>
      </div>
    </main>
  );
}
