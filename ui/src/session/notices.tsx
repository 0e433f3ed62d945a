import { Button, Group } from '@mantine/core';
import { notifications } from '@mantine/notifications';

const SHORT_MS = 4000;
const LONG_MS = 12_000;

/** Colour, and how long it is left. */
const TONES = {
  good: ['good', SHORT_MS],
  info: ['gray', SHORT_MS],
  /** To be read to its end: something went another way than people expect. */
  kept: ['gray', LONG_MS],
  error: ['bad', LONG_MS],
} as const;

/** Says something in the corner, and takes it back by itself. */
export function tell(tone: keyof typeof TONES, message: string) {
  const [color, autoClose] = TONES[tone];
  notifications.show({
    message,
    color,
    autoClose,
    withBorder: true,
    closeButtonProps: { 'aria-label': 'Close' },
    role: tone === 'error' ? 'alert' : 'status',
  });
}

/** How long something that was done can be undone from the corner, milliseconds. */
const UNDO_MS = 15_000;

/** Says what was done, with a button that undoes it. */
export function tellWithUndo(message: string, undo: () => void) {
  const id = notifications.show({
    message: (
      <Group justify="space-between" wrap="nowrap">
        {message}
        <Button
          size="compact-sm"
          variant="default"
          onClick={() => {
            notifications.hide(id);
            undo();
          }}
        >
          Undo
        </Button>
      </Group>
    ),
    color: 'gray',
    autoClose: UNDO_MS,
    withBorder: true,
    closeButtonProps: { 'aria-label': 'Close' },
    role: 'status',
  });
}
