import { notifications } from '@mantine/notifications';

/** Says something in the corner. Errors stay until they are closed. */
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
