import { expect, test } from 'vitest';
import { createSounding } from './sounding';

test('music that is closed while it is opened is not opened any more', async () => {
  let made = 0;
  let closed = 0;
  const out = {
    lasts_s: 1,
    made_s: () => 0,
    heard_s: () => null,
    start: () => ({ setRate: () => undefined, stop: () => undefined }),
    close: () => void closed++,
  };
  let arrive = () => {};
  const file = () =>
    new Promise<Uint8Array<ArrayBuffer>>((resolve) => (arrive = () => resolve(new Uint8Array(1))));
  const sounding = createSounding(file, async () => (made++, out));
  const opened = sounding.open('a');
  await Promise.resolve();
  sounding.close();
  arrive();
  await opened;
  expect([made, closed]).toEqual([1, 1]);

  // Opened, closed, opened and closed while the file of the first opening is on its way.
  const first = sounding.open('a');
  await Promise.resolve();
  sounding.close();
  const second = sounding.open('a');
  sounding.close();
  arrive();
  await Promise.all([first, second]);
  expect(closed).toBe(made);

  const again = sounding.open('a');
  await new Promise((resolve) => setTimeout(resolve));
  arrive();
  await again;
  expect(closed).toBe(made - 1);
  sounding.close();
  expect(closed).toBe(made);
});
