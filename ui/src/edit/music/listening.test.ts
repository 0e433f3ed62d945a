import { expect, test, vi } from 'vitest';
import { createListening } from './listening';

test('a stop while the file is opened keeps the music from being heard', async () => {
  const request = vi.fn();
  vi.stubGlobal('requestAnimationFrame', request);
  vi.stubGlobal('cancelAnimationFrame', () => undefined);
  let open = () => {};
  const sounding = {
    open: () => new Promise<void>((resolve) => (open = resolve)),
    follow: () => undefined,
    close: () => undefined,
  };
  const listening = createListening(sounding);
  const started = listening.start('a', 0, 9);
  listening.stop();
  open();
  await started;
  expect(request).not.toHaveBeenCalled();

  const again = listening.start('a', 0, 9);
  open();
  await again;
  expect(request).toHaveBeenCalledOnce();
  vi.unstubAllGlobals();
});
