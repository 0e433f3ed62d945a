import { Button, Group, Text, Title } from '@mantine/core';
import { useEffect, useState } from 'react';
import { listShows, putShow } from '../api/http';
import { messageOf } from '../base/errors';
import { countText } from '../base/numbers';
import { assetsOf } from '../model/assets';
import { fleetSize } from '../model/commands';
import { middleFrame, type Show } from '../model/show';
import { unpackShow, type LinkedShow } from '../model/showLink';
import { Gate, useWhyNot } from '../parts/Gate';
import { editShow, goTo, useShared } from '../session/address';
import { notify } from '../session/notices';
import { freeName, nameFromFile } from '../session/upload';
import { Thumbnail } from '../stage/Thumbnail';
import page from '../parts/page.module.css';
import styles from './Shared.module.css';

/** Shows what the packed show in the address is, and offers to save it in the library as a new show. */
export default function SharedPage() {
  const packed = useShared();
  return <Linked key={packed} packed={packed} />;
}

function Linked({ packed }: { packed: string }) {
  const [linked, setLinked] = useState<LinkedShow | null>(null);
  const [failure, setFailure] = useState<string | null>(null);
  useEffect(() => {
    unpackShow(packed).then(setLinked, (error: unknown) => setFailure(messageOf(error)));
  }, [packed]);
  if (failure !== null)
    return (
      <main className={page.empty}>
        <Title order={1} size="lg">
          This link cannot be opened
        </Title>
        <Text c="dimmed" maw="40rem" role="alert">
          {failure}
        </Text>
        <Button onClick={() => goTo('live')}>Leave</Button>
      </main>
    );
  return linked ? <Facts linked={linked} /> : <main aria-busy />;
}

/** Longest title that is shown, characters: a link may hold any. */
const TITLE_MAX = 120;
/** Largest radius with which robots are drawn, metres: a link may hold any. */
const RADIUS_MAX_M = 0.2;

/** The show's title, cut to `TITLE_MAX`, or words for a show without one. */
const titleOf = ({ name }: Show) => name.trim().slice(0, TITLE_MAX) || 'A show without a name';

function Facts({ linked: { document, show } }: { linked: LinkedShow }) {
  const [isSaving, setSaving] = useState(false);
  const reason = useWhyNot('editor', 'open it as a new show');
  const frame = middleFrame(show);
  const [stage] = useState({
    ...show.stage,
    radius_m: Math.min(show.stage.radius_m, RADIUS_MAX_M),
  });
  const files = assetsOf(show).size;
  const save = async () => {
    setSaving(true);
    try {
      const taken = (await listShows()).map(({ name }) => name);
      const name = freeName(nameFromFile(show.name), taken);
      const entry = await putShow(name, JSON.stringify(document), 'new');
      notify('good', `Saved as "${entry.name}".`);
      editShow(entry.name);
    } catch (error) {
      notify('error', `Can't save the show of this link: ${messageOf(error)}`);
      setSaving(false);
    }
  };
  return (
    <main className={page.empty}>
      <span className={styles.picture}>
        {frame ? <Thumbnail frame={frame} stage={stage} /> : null}
      </span>
      <Title order={1} size="lg" className={styles.title}>
        {titleOf(show)}
      </Title>
      <Text>
        {countText(fleetSize(show), 'robot')}, {countText(show.frames.length, 'frame')}
      </Text>
      <Text c="dimmed" maw="34rem">
        This show came with a link. Nothing is saved until you open it.
        {files > 0 ? ` Its ${countText(files, 'file')} did not come with it.` : null}
      </Text>
      {reason === null ? null : <Text role="note">{reason}</Text>}
      <Group>
        <Button variant="default" onClick={() => goTo('live')}>
          Leave
        </Button>
        <Gate needs="editor" act="open it as a new show">
          <Button loading={isSaving} onClick={() => void save()}>
            Open as a new show
          </Button>
        </Gate>
      </Group>
    </main>
  );
}
