import { expect, test } from 'vitest';
import { createSounding } from './sounding';

test('music that is closed while it is opened is not opened any more', async () => {
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
  const sounding = createSounding(file, async () => out);
  const opened = sounding.open('a');
  await Promise.resolve();
  sounding.close();
  arrive();
  await opened;
  expect(closed).toBe(1);

  const again = sounding.open('a');
  await new Promise((resolve) => setTimeout(resolve));
  arrive();
  await again;
  expect(closed).toBe(1);
  sounding.close();
  expect(closed).toBe(2);
});
