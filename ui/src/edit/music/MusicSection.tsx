import { Button, Checkbox, FileButton, Group, Stack, Text } from '@mantine/core';
import { useStore } from '../../base/store';
import { clockText } from '../../base/time';
import { musicOf, withoutMusic } from '../../model/beats';
import { useEditing, useEditor } from '../context';
import type { Editing } from '../editing';
import { takeFiles } from '../taking';
import { useSession, type Session } from '../../session/session';
import { BeatFields } from './BeatFields';
import { HeardWave } from './HeardWave';
import { MUSIC_FILES } from './musicActs';
import { previewSound } from './previewSound';
import styles from './Music.module.css';

/** The music of the show and its beats. */
export function MusicSection() {
  const session = useSession();
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const file = musicOf(show);
  return (
    <Stack gap="xs" component="section" aria-label="Music">
      <Text size="sm" fw={600}>
        Music
      </Text>
      {file ? <Chosen name={file.name} /> : null}
      {!file && show.music !== null ? (
        <Text size="xs" c="dimmed">
          The show names {show.music}, and does not hold that file. Add it to hear it here.
        </Text>
      ) : null}
      <Group gap="xs">
        <ChooseButton session={session} editing={editing} isFirst={!file} />
        {show.music !== null ? (
          <Button
            size="xs"
            variant="subtle"
            color="gray"
            onClick={() => editing.editor.change('Remove music', withoutMusic)}
          >
            Remove
          </Button>
        ) : null}
      </Group>
    </Stack>
  );
}

interface ChooseProps {
  session: Session;
  editing: Editing;
  isFirst: boolean;
}

function ChooseButton({ session, editing, isFirst }: ChooseProps) {
  const take = (file: File | null) => {
    if (file) void takeFiles(session, editing, [file]);
  };
  return (
    <FileButton accept={MUSIC_FILES} onChange={take}>
      {(props) => (
        <Button {...props} size="xs" variant="default">
          {isFirst ? 'Add music…' : 'Other music…'}
        </Button>
      )}
    </FileButton>
  );
}

function Chosen({ name }: { name: string }) {
  const { music } = useEditing();
  const state = useStore(music.state);
  return (
    <>
      <Text size="xs" className={styles.name} title={name}>
        {name}
        {state.of === 'ready' ? ` · ${clockText(state.music.lasts_s)}` : ''}
      </Text>
      {state.of === 'loading' ? (
        <Text size="xs" c="dimmed" role="status">
          Reading the music…
        </Text>
      ) : null}
      {state.of === 'failed' ? (
        <Text size="xs" c="var(--bad)" role="alert">
          The music cannot be shown: {state.why}
        </Text>
      ) : null}
      {state.of === 'ready' ? (
        <>
          <HeardWave music={state.music} />
          <PreviewSound />
          <BeatFields lasts_s={state.music.lasts_s} />
        </>
      ) : null}
    </>
  );
}

const PreviewSound = () => (
  <Checkbox
    size="xs"
    label="Hear it with the preview"
    checked={useStore(previewSound) === 'on'}
    onChange={(event) => previewSound.set(event.currentTarget.checked ? 'on' : 'off')}
  />
);
