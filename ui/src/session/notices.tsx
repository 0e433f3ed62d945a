import { messageOf } from '../base/errors';
import { Button, Group } from '@mantine/core';
import { notifications } from '@mantine/notifications';

/** Time after which a short notice closes by itself, milliseconds. */
const SHORT_MS = 4000;
/** Time after which a long notice closes by itself, milliseconds. */
const LONG_MS = 12_000;

/** For each tone the colour, and the time until the notice closes, milliseconds; false: it stays. */
const TONES = {
  good: ['good', SHORT_MS],
  info: ['gray', SHORT_MS],
  /** Shown longer, because the outcome differs from what the user expects. */
  kept: ['gray', LONG_MS],
  error: ['bad', LONG_MS],
  /** Stays until the user closes it: something was lost, and nothing else on the screen says so. */
  warning: ['care', false],
} as const;

/** Shows a notice in the corner for as long as `TONES` says; its message may have several lines. */
export function notify(tone: keyof typeof TONES, message: string) {
  const [color, autoClose] = TONES[tone];
  notifications.show({
    message,
    color,
    autoClose,
    withBorder: true,
    styles: { description: { whiteSpace: 'pre-line' } },
    closeButtonProps: { 'aria-label': 'Close' },
    role: tone === 'error' ? 'alert' : 'status',
  });
}

/** Runs an action; if it fails, a notice says why. */
export function attempt(act: () => Promise<void>) {
  void act().catch((e: unknown) => notify('error', messageOf(e)));
}

/** Time that a notice offers to undo an action, milliseconds. */
const UNDO_MS = 15_000;

/** Shows a notice with a button that undoes the action. */
export function notifyWithUndo(message: string, undo: () => void) {
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
