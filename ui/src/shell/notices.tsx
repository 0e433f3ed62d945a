import { Button, Group } from '@mantine/core';
import { notifications } from '@mantine/notifications';

/** Says something in the corner, and takes it back by itself; errors are left for longer. */
export function tell(tone: 'good' | 'info' | 'error', message: string) {
  notifications.show({
    message,
    color: { good: 'teal', info: 'gray', error: 'red' }[tone],
    autoClose: tone === 'error' ? 12_000 : 4000,
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
