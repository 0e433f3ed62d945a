import { Button, Group, Text, Title } from '@mantine/core';
import { lazy, Suspense, useEffect, useRef, useState } from 'react';
import { useStore } from '../base/store';
import { useWhyNot } from '../parts/Gate';
import { Bottom } from '../parts/Bottom';
import { useSession } from '../session/session';
import { goTo } from '../session/address';
import { ConflictDialog } from './ConflictDialog';
import { EditingContext, useEditing } from './context';
import { EditBar } from './EditBar';
import { createEditing, type Editing } from './editing';
import { EditKeys } from './EditKeys';
import { EditStage } from './EditStage';
import { EditStrip } from './EditStrip';
import { Inspector } from './Inspector';
import { MakePanel } from './MakePanel';
import { ReadOnlyPage } from './ReadOnlyPage';
import { Taking } from './Taking';
import { framesView } from './timeline/framesView';
import { Tour } from './Tour';
import styles from '../parts/page.module.css';

/** Loaded when it is first shown. */
const TimelinePanel = lazy(() => import('./timeline/TimelinePanel'));

/** What this page edits; kept when the view changes, so that undo survives a visit to the live view. */
let kept: Editing | null = null;

/** The page of the editor, or what stands in its place. */
export function EditPage() {
  const session = useSession();
  const shown = useStore(session.shown);
  const restoring = useStore(session.restoring);
  const reason = useWhyNot('editor', 'change shows');
  const [editing, setEditing] = useState(kept);
  const last = useRef(kept);
  useEffect(() => {
    const { name, show, etag, readOnly } = shown;
    if (!show || name === null || readOnly !== null || reason !== null) return;
    const wanted = restoring?.name === name ? restoring.id : null;
    if (last.current?.name === name && wanted === null) return;
    last.current?.retire();
    if (wanted !== null) session.restoring.set(null);
    kept = last.current = createEditing(session, name, show, etag, wanted);
    session.editing.set(kept);
    setEditing(kept);
  }, [session, shown, restoring, reason]);
  if (reason !== null) return <NotYours reason={reason} />;
  if (shown.name !== null && shown.readOnly !== null)
    return <ReadOnlyPage name={shown.name} reason={shown.readOnly} />;
  if (shown.failure !== null) return <NotShown failure={shown.failure} />;
  if (!editing) return <NothingOpen />;
  return (
    <EditingContext value={editing}>
      <main className={styles.page} key={editing.keeper.id}>
        <EditStage />
        <Bottom label="Frames and time">
          <EditBar />
          <Frames />
        </Bottom>
        <Side />
        <EditKeys />
        <Taking />
        <ConflictDialog />
        <Tour />
      </main>
    </EditingContext>
  );
}

/** In place of the editor: no show is open. */
const NothingOpen = () => (
  <main className={styles.empty}>
    <Title order={1} size="lg">
      Nothing to draw on yet
    </Title>
    <Text c="dimmed">Create a show, open one above, or drop a file anywhere.</Text>
    <Group>
      <Button onClick={() => goTo('new')}>New show</Button>
    </Group>
  </main>
);

/** In place of the editor: the role of this person is not enough. */
const NotYours = ({ reason }: { reason: string }) => (
  <main className={styles.empty}>
    <Title order={1} size="lg">
      You can watch this show, not change it
    </Title>
    <Text c="dimmed">{reason}</Text>
    <Button onClick={() => goTo('live')}>Watch it live</Button>
  </main>
);

/** In place of the editor: the show in the address cannot be shown. */
const NotShown = ({ failure }: { failure: string }) => (
  <main className={styles.empty}>
    <Title order={1} size="lg">
      This show is not here
    </Title>
    <Text c="dimmed" maw="40rem">
      {failure}
    </Text>
    <Button onClick={() => goTo('edit')}>Edit the open show</Button>
  </main>
);

/** The frames below the stage: as pictures, or on the timeline. */
function Frames() {
  const view = useStore(framesView);
  if (view === 'pictures') return <EditStrip />;
  return (
    <Suspense>
      <TimelinePanel />
    </Suspense>
  );
}

/** Properties, or the Make panel while a frame is made. */
function Side() {
  const making = useStore(useEditing().making);
  return making ? <MakePanel making={making} /> : <Inspector />;
}
