import { Tabs } from '@mantine/core';
import { lazy, Suspense } from 'react';
import { useStore } from '../base/store';
import { IssueList } from '../parts/IssueList';
import { ArrangeSection } from './ArrangeSection';
import { ColourSection } from './ColourSection';
import { useEditing } from './context';
import { FloorSection } from './FloorSection';
import { FrameSection } from './FrameSection';
import { MadeFrom } from './MadeFrom';
import { MotionSection } from './motion/MotionSection';
import { MusicSection } from './music/MusicSection';
import { PlaceSection } from './PlaceSection';
import { RobotsSection } from './RobotsSection';
import { ShowSection } from './ShowSection';
import styles from '../parts/page.module.css';

/** Loaded when it is first shown. */
const LightPanel = lazy(() => import('./light/LightPanel'));

/** Tabs with the properties of the chosen pixels, the frames, the light and the show. */
export function Inspector() {
  const { editor, plan } = useEditing();
  const issues = useStore(plan, (plan) => plan?.issues) ?? [];
  return (
    <aside className={styles.side} aria-label="Properties">
      <MadeFrom />
      <Tabs defaultValue="pixels">
        <Tabs.List grow>
          <Tabs.Tab value="pixels">Pixels</Tabs.Tab>
          <Tabs.Tab value="frame">Frame</Tabs.Tab>
          <Tabs.Tab value="light">Light</Tabs.Tab>
          <Tabs.Tab value="show">
            Show{issues.some((i) => i.severity !== 'note') ? ' •' : ''}
          </Tabs.Tab>
        </Tabs.List>
        <Tabs.Panel value="pixels" className={styles.sections}>
          <PlaceSection />
          <ArrangeSection />
          <ColourSection />
        </Tabs.Panel>
        <Tabs.Panel value="frame" className={styles.sections} keepMounted={false}>
          <FrameSection />
          <MotionSection />
        </Tabs.Panel>
        <Tabs.Panel value="light" className={styles.sections} keepMounted={false}>
          <Suspense>
            <LightPanel />
          </Suspense>
        </Tabs.Panel>
        <Tabs.Panel value="show" className={styles.sections}>
          <ShowSection />
          <IssueList issues={issues} onFrame={(index) => editor.goToFrame(index)} />
          <MusicSection />
          <RobotsSection />
          <FloorSection />
        </Tabs.Panel>
      </Tabs>
    </aside>
  );
}
