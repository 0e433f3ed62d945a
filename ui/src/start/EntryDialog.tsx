import {
  Button,
  Checkbox,
  Group,
  Modal,
  NativeSelect,
  SegmentedControl,
  Stack,
  TextInput,
} from '@mantine/core';
import { useEffect, useState } from 'react';
import { listShows } from '../api/http';
import type { PlaylistDay, PlaylistEntry } from '../api/types.gen';
import { NumberField } from '../parts/NumberField';
import { attempt } from '../session/libraryActs';
import { DAYS } from '../session/playlist';
import { DayButtons } from './DayButtons';

interface Props {
  /** null: a new entry. */
  entry: PlaylistEntry | null;
  /** Whether the entry is the first one: it has none before it, and needs a time of day. */
  isFirst: boolean;
  /** Local time of the server, with which the field for the time of a new entry begins. */
  now: string;
  onSave: (entry: PlaylistEntry) => void;
  onClose: () => void;
}

/** Speeds of drives that are offered, percent. */
const SPEEDS = [30, 50, 100];
/** The longest pause that the server takes, minutes. */
const PAUSE_MAX_MIN = 720;
/** Pause with which a new entry begins, minutes. */
const PAUSE_USUAL_MIN = 15;

/** A dialog for show, start and speed of an entry of the playlist. */
export function EntryDialog({ entry, isFirst, now, onSave, onClose }: Props) {
  const [names, setNames] = useState<readonly string[]>([]);
  const [show, setShow] = useState(entry?.show ?? '');
  const [isTimed, setTimed] = useState(isFirst || Boolean(entry?.at));
  const [at, setAt] = useState(entry?.at ?? now);
  const [days, setDays] = useState<readonly PlaylistDay[]>(entry?.weekdays ?? []);
  const [pause_min, setPause] = useState(entry?.pause_min ?? PAUSE_USUAL_MIN);
  const [home, setHome] = useState(entry?.home ?? false);
  const [speed_percent, setSpeed] = useState(entry?.speed_percent ?? 100);
  useEffect(() => {
    void attempt(async () => {
      const found = (await listShows()).map(({ name }) => name);
      setNames(found);
      setShow((chosen) => chosen || (found[0] ?? ''));
    });
  }, []);
  const weekdays = DAYS.map(({ value }): PlaylistDay => value).filter((day) => days.includes(day));
  const save = () => {
    const base = { id: entry?.id ?? 0, show, speed_percent };
    onSave(isTimed ? { ...base, at, weekdays } : { ...base, pause_min, home });
  };
  return (
    <Modal opened onClose={onClose} title={entry ? 'Change the entry' : 'Add to the playlist'}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          save();
        }}
      >
        <Stack gap="sm">
          <NativeSelect
            label="Show"
            data-autofocus
            data={[...new Set([...names, ...(show ? [show] : [])])]}
            value={show}
            onChange={({ currentTarget: { value } }) => setShow(value)}
          />
          <SegmentedControl
            aria-label="Start"
            disabled={isFirst}
            value={isTimed ? 'at' : 'after'}
            onChange={(value) => setTimed(value === 'at')}
            data={[
              { value: 'at', label: 'At a time' },
              { value: 'after', label: 'After the show before' },
            ]}
          />
          {isTimed ? (
            <>
              <TextInput
                type="time"
                label="Time (of the server)"
                required
                value={at}
                onChange={({ currentTarget: { value } }) => setAt(value)}
              />
              <DayButtons days={days} onDays={setDays} />
            </>
          ) : (
            <>
              <NumberField
                label="Pause after it, minutes"
                value={pause_min}
                min={0}
                max={PAUSE_MAX_MIN}
                whole
                onChange={setPause}
              />
              <Checkbox
                label="Robots drive home for the pause"
                checked={home}
                onChange={({ currentTarget: { checked } }) => setHome(checked)}
              />
            </>
          )}
          <NativeSelect
            label="Speed of drives"
            data={[...new Set([...SPEEDS, speed_percent])]
              .sort((a, b) => a - b)
              .map((speed) => ({ value: String(speed), label: `${speed} %` }))}
            value={String(speed_percent)}
            onChange={({ currentTarget: { value } }) => setSpeed(Number(value))}
          />
          <Group justify="flex-end" mt="sm">
            <Button variant="default" onClick={onClose}>
              Cancel
            </Button>
            <Button type="submit" disabled={show === ''}>
              {entry ? 'Change' : 'Add'}
            </Button>
          </Group>
        </Stack>
      </form>
    </Modal>
  );
}
