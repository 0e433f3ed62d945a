import { Checkbox, TextInput } from '@mantine/core';
import { useState } from 'react';
import { useStore } from '../../base/store';
import type { PadsState } from '../light/midiPads';
import { codeText, readClock } from './timeCode';
import { startClock, type LiveTimeCode } from './useTimeCode';
import styles from '../light/LightTab.module.css';

const WHY_NOT: Partial<Record<PadsState, string>> = {
  off: 'Use MIDI pads first: time code comes from the same devices.',
  asking: 'Answer the question of the browser about MIDI devices.',
};

/** MIDI time code: whether it plays the show, from which time on, and the code now; nothing without MIDI. */
export function TimeCodeFields({ code, midi }: { code: LiveTimeCode; midi: PadsState }) {
  const isOn = useStore(code.isOn);
  const now = useStore(code.code_s, (time_s) => (time_s === null ? null : codeText(time_s)));
  const start = useStore(startClock);
  const [typed, setTyped] = useState<string | null>(null);
  if (midi === 'missing' || midi === 'refused') return null;
  const text = typed ?? start;
  const isTime = readClock(text) !== null;
  const take = () => {
    if (!isTime) return;
    startClock.set(text.trim());
    setTyped(null);
  };
  return (
    <div className={styles.pads}>
      <Checkbox
        size="xs"
        label="MIDI time code plays the show"
        disabled={midi !== 'on'}
        checked={isOn && midi === 'on'}
        onChange={(event) => code.isOn.set(event.currentTarget.checked)}
      />
      <TextInput
        size="xs"
        label="It begins at"
        description="Hours, minutes and seconds of the code"
        value={text}
        disabled={midi !== 'on'}
        error={isTime ? undefined : 'Type a time such as 01:00:00'}
        errorProps={{ role: 'alert' }}
        onChange={(event) => setTyped(event.currentTarget.value)}
        onBlur={take}
        onKeyDown={(event) => {
          if (event.key === 'Enter') take();
        }}
      />
      <p className={`quiet ${styles.line}`} data-testid="time-code">
        {WHY_NOT[midi] ?? (now === null ? 'No time code comes.' : `Time code ${now}`)}
      </p>
    </div>
  );
}
