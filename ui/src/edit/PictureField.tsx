import { IconPlayerPauseFilled, IconPlayerPlayFilled } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import type { Making } from '../make/making';
import { IconButton } from '../parts/IconButton';
import { SliderField } from './SliderField';
import styles from './Make.module.css';

/** How long each picture is shown while the pictures run, milliseconds: long enough to see it. */
const STEP_MS = 500;

/** Chooses which of several made pictures the stage shows, or runs through them; nothing for one picture. */
export function PictureField({ making }: { making: Making }) {
  const shown = useStore(making.made, (made) => made.shown);
  const at = useStore(making.at);
  const [isRunning, setRunning] = useState(false);
  const pictures = shown?.pictures ?? [];
  const count = pictures.length;
  useEffect(() => {
    if (!isRunning || count < 2) return;
    const timer = setInterval(() => making.at.update((now) => (now + 1) % count), STEP_MS);
    return () => clearInterval(timer);
  }, [isRunning, count, making]);
  if (!shown || count < 2) return null;
  const stays_s = pictures.reduce((sum, { airTime_s }) => sum + (airTime_s ?? 0), 0);
  const now = Math.min(at, count - 1);
  return (
    <div className={styles.pictures}>
      <SliderField
        label="Picture"
        text={`${now + 1} of ${count}${stays_s > 0 ? ` · ${clockText(stays_s)} standing` : ''}`}
        min={1}
        max={count}
        step={1}
        value={now + 1}
        onChange={(value) => {
          setRunning(false);
          making.at.set(value - 1);
        }}
      />
      <IconButton
        label={isRunning ? 'Stop the pictures' : 'Run through the pictures'}
        size="lg"
        onClick={() => setRunning(!isRunning)}
      >
        {isRunning ? <IconPlayerPauseFilled size={16} /> : <IconPlayerPlayFilled size={16} />}
      </IconButton>
    </div>
  );
}
