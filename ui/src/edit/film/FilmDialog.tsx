import { Button, Group, Modal, Progress, Select, Stack, Switch, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { useStore } from '../../base/store';
import type { FilmKind } from '../../film/protocol';
import { musicOf } from '../../model/beats';
import { useEditing, useEditor } from '../context';
import { useFilm, type FilmState } from './useFilm';

const SIZES = {
  '1280x720': '1280 × 720',
  '1920x1080': '1920 × 1080',
  '1080x1080': '1080 × 1080, square',
  '720x1280': '720 × 1280, upright',
};
const KINDS: Record<FilmKind, string> = { mp4: 'MP4 (H.264)', webm: 'WebM (VP9)' };
const VIEWS = { above: 'From above', front: "From the audience's seats" };
/** Pictures a second of the film. */
const FPS = 30;

interface ChoiceProps<T extends string> {
  label: string;
  of: Readonly<Record<T, string>>;
  value: T;
  onChange: (to: T) => void;
  disabled: boolean;
}

function Choice<T extends string>({ of, onChange, ...props }: ChoiceProps<T>) {
  const data = Object.entries<string>(of).map(([value, label]) => ({ value, label }));
  const choose = (to: string | null) => to !== null && onChange(to as T);
  return <Select {...props} data={data} onChange={choose} allowDeselect={false} />;
}

/** A dialog that makes a film of the show, as the audience sees it, and saves it as a file. It needs the plan. */
export default function FilmDialog({ onClose }: { onClose: () => void }) {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const plan = useStore(editing.full.plan);
  useEffect(() => editing.full.follow(), [editing]);
  const [size, setSize] = useState<keyof typeof SIZES>('1280x720');
  const [kind, setKind] = useState<FilmKind>('mp4');
  const [view, setView] = useState<keyof typeof VIEWS>('above');
  const hasMusic = musicOf(show) !== null;
  const [withMusic, setWithMusic] = useState(hasMusic);
  const { state, make, cancel } = useFilm(editing);
  const isMaking = state.of === 'making';
  const isPlanned = plan !== null && plan.transitions.length === show.frames.length;
  const begin = () => {
    if (!plan) return;
    const [width = 0, height = 0] = size.split('x').map(Number);
    void make(plan, { kind, width, height, fps: FPS, fromFront: view === 'front' }, withMusic);
  };
  const leave = () => {
    cancel();
    onClose();
  };
  return (
    <Modal opened onClose={leave} title="Film of the show">
      <Stack>
        <Choice label="View" of={VIEWS} value={view} onChange={setView} disabled={isMaking} />
        <Choice label="Size" of={SIZES} value={size} onChange={setSize} disabled={isMaking} />
        <Choice label="File" of={KINDS} value={kind} onChange={setKind} disabled={isMaking} />
        {hasMusic ? (
          <Switch
            label="With the music of the show"
            checked={withMusic}
            onChange={(event) => setWithMusic(event.currentTarget.checked)}
            disabled={isMaking}
          />
        ) : null}
        <FilmProgress state={state} isPlanned={isPlanned} />
        <Group justify="flex-end">
          <Button variant="default" onClick={isMaking ? cancel : leave}>
            {isMaking ? 'Cancel' : 'Close'}
          </Button>
          <Button onClick={begin} disabled={isMaking || !isPlanned} data-autofocus>
            Make the film
          </Button>
        </Group>
      </Stack>
    </Modal>
  );
}

function FilmProgress({ state, isPlanned }: { state: FilmState; isPlanned: boolean }) {
  if (!isPlanned)
    return (
      <Text size="sm">
        The film needs the plan of this show. It is made while the show is the open one.
      </Text>
    );
  if (state.of === 'making') {
    const percent = Math.floor(100 * state.share);
    return (
      <div role="status">
        <Text size="sm">Painting: {percent} %</Text>
        <Progress value={percent} aria-label="How far the film is" />
      </div>
    );
  }
  if (state.of === 'made')
    return (
      <Text size="sm" role="status">
        The film is saved: {(state.bytes / 1e6).toFixed(1)} MB.
      </Text>
    );
  if (state.of === 'failed')
    return (
      <Text size="sm" role="alert">
        {state.message}
      </Text>
    );
  return null;
}
