import { Button, Group, Text } from '@mantine/core';
import { useState } from 'react';
import styles from './Tour.module.css';

const KEY = 'lightbots-tour';
const STEPS = [
  [
    'Every dot is a robot',
    'Click one or draw a box around some, then drag them where they should be. Or press Make, on the right, for words, shapes and drawings.',
  ],
  [
    'Give them light',
    'Pick a colour on the right: it applies to the selected pixels, or to all. Everything can be undone with Ctrl Z.',
  ],
  [
    'Add the next picture',
    'The + beside the strip adds a frame. How the robots get there is planned for you, without collisions.',
  ],
  [
    'Preview it, then run it',
    'The arrow under the floor previews it here. Run on robots saves it, opens the live view, and starts the show.',
  ],
] as const;

const seen = () => {
  try {
    return localStorage.getItem(KEY) !== null;
  } catch {
    return true;
  }
};

/** The first steps, shown until they are ended once in this browser; never without storage. */
export function Tour() {
  const [step, setStep] = useState(() => (seen() ? STEPS.length : 0));
  const now = STEPS[step];
  if (!now) return null;
  const end = () => {
    try {
      localStorage.setItem(KEY, 'done');
    } catch {
      // It could not be noted: the tour may be shown again.
    }
    setStep(STEPS.length);
  };
  const last = step === STEPS.length - 1;
  return (
    <div className={styles.tour} role="region" aria-label="First steps">
      <Text fw={600} mb={4}>
        {now[0]}
      </Text>
      <Text size="sm" mb="md">
        {now[1]}
      </Text>
      <Group justify="space-between">
        <Text size="xs" c="dimmed">
          {step + 1} of {STEPS.length}
        </Text>
        <Group gap="xs">
          {last ? null : (
            <Button size="compact-sm" variant="subtle" color="gray" onClick={end}>
              Skip
            </Button>
          )}
          <Button size="compact-sm" onClick={() => (last ? end() : setStep(step + 1))}>
            {last ? 'Begin' : 'Next'}
          </Button>
        </Group>
      </Group>
    </div>
  );
}
