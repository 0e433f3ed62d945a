import { Button, Group, Text } from '@mantine/core';
import { useState } from 'react';
import {
  barsLater,
  BPM,
  doubled,
  halved,
  nudged,
  shifted,
  tempoOf,
  withBeats,
  type Beats,
} from '../../model/beats';
import { NumberField } from '../../parts/NumberField';
import { useEditing } from '../context';
import { ArrangeDialog } from './ArrangeDialog';
import { findBeatsAgain } from './musicActs';
import { TapButton } from './TapButton';
import { useBeats } from './useBeats';
import styles from './Music.module.css';

/** Corrections of beats: label of the button, label in the history, and the beats after it. */
const CHANGES: [string, string, (beats: Beats) => Beats][] = [
  ['×2', 'Twice as many beats', doubled],
  ['÷2', 'Every second beat', halved],
  ['½ beat later', 'Beats half a beat later', (beats) => shifted(beats, 0.5)],
  ['Bar 1 beat later', 'Bars one beat later', barsLater],
  ['10 ms earlier', 'Beats 10 ms earlier', (beats) => nudged(beats, -0.01)],
  ['10 ms later', 'Beats 10 ms later', (beats) => nudged(beats, 0.01)],
];

/** Tempo and bars of the music, buttons that correct them, and those that find beats anew. `lasts_s`: the music's. */
export function BeatFields({ lasts_s }: { lasts_s: number }) {
  const editing = useEditing();
  const beats = useBeats();
  const [isArranging, setArranging] = useState(false);
  const change = (name: string, next: Beats | null) => {
    if (next) editing.editor.change(name, (show) => withBeats(show, next));
  };
  const find = async () => change('Beats', await findBeatsAgain(editing));
  return (
    <>
      {beats ? (
        <>
          <Group gap="xs" grow align="end">
            <NumberField
              label="Beats a minute"
              description={
                beats.grid.of === 'steady' ? 'Steady' : 'Changing: a number makes it steady'
              }
              min={BPM.min}
              max={BPM.max}
              digits={2}
              value={tempoOf(beats)}
              onChange={(bpm) => change('Tempo', steadyAt(beats, bpm))}
            />
            <NumberField
              label="Beats of a bar"
              description="4 in most music"
              whole
              min={1}
              max={32}
              value={beats.perBar}
              onChange={(perBar) => change('Beats of a bar', { ...beats, perBar })}
            />
          </Group>
          <div className={styles.buttons} role="group" aria-label="Correct the beats">
            {CHANGES.map(([label, name, changed]) => (
              <Button
                key={label}
                size="compact-xs"
                variant="default"
                onClick={() => change(name, changed(beats))}
              >
                {label}
              </Button>
            ))}
          </div>
        </>
      ) : (
        <Text size="xs" c="dimmed">
          No beats are known. Find them, or tap along.
        </Text>
      )}
      <div className={styles.buttons}>
        <TapButton lasts_s={lasts_s} />
        <Button size="compact-xs" variant="default" onClick={() => void find()}>
          Find beats
        </Button>
        <Button
          size="compact-xs"
          variant="default"
          disabled={!beats}
          onClick={() => setArranging(true)}
        >
          Arrange to music…
        </Button>
      </div>
      <ArrangeDialog opened={isArranging} onClose={() => setArranging(false)} />
    </>
  );
}

/** Beats of a steady tempo, beats a minute, from the first of the given beats on. */
function steadyAt({ grid, perBar }: Beats, bpm: number): Beats {
  const offset_s = grid.of === 'steady' ? grid.offset_s : (grid.times_s[0] ?? 0);
  return { perBar, grid: { of: 'steady', bpm, offset_s } };
}
