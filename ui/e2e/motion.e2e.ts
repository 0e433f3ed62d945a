import { expect, test } from 'vitest';
import { button, phaseIs, pixelsAre, saved, smallShow, stored, uploadText } from './journeys';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

interface StoredFrame {
  motion?: Record<string, unknown>;
  pixels: { id: number; place: [number, number] }[];
}

test('a picture turns: chosen, changed and undone in the editor, and played', async () => {
  const page = await bed.open('edit');
  await uploadText(page, 'turning.json', smallShow(6));
  await pixelsAre(page, 6);
  const frames = async () =>
    ((await stored(page, 'turning')) as unknown as { frames: StoredFrame[] }).frames;
  const before = (await frames())[1];
  await page.getByRole('tab', { name: 'Frame' }).click();
  const way = page.getByRole('combobox', { name: 'Way here' });
  await page.getByText('The first frame has no picture before it').waitFor();
  await page.getByRole('list', { name: 'Frames' }).getByRole('button', { name: /^2/ }).click();
  await way.click();
  await page.getByRole('option', { name: 'The picture turns' }).click();
  const turn = page.getByRole('textbox', { name: 'Turn (°)' });
  await turn.fill('180');
  await turn.press('Enter');
  await turn.blur();
  await saved(page);

  const [first, second] = await frames();
  expect(second?.motion).toMatchObject({ kind: 'turn', size: 1 });
  const middle = [0, 1].map((axis) => {
    const values = first?.pixels.map((p) => p.place[axis] ?? 0) ?? [];
    return (Math.min(...values) + Math.max(...values)) / 2;
  });
  for (const [i, { place }] of (first?.pixels ?? []).entries()) {
    const turned = second?.pixels[i]?.place ?? [NaN, NaN];
    for (const axis of [0, 1])
      expect(turned[axis]).toBeCloseTo(2 * (middle[axis] ?? 0) - (place[axis] ?? 0), 3);
  }
  // The least time is stated before anything is asked for.
  await page.getByText(/^at least [\d.]+ s$/).waitFor();

  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await saved(page);
  expect((await frames())[1]).toEqual(before);
  await page.keyboard.press('Control+Shift+z');
  await page.keyboard.press('Control+Shift+z');
  await saved(page);

  await button(page, 'Run on robots').click();
  await page.getByText('Playing frame 2 of 2').waitFor();
  await phaseIs(page, 'ready');
});

test('a motion that is asked too fast says how long it takes at least', async () => {
  const page = await bed.open('edit');
  const show = JSON.parse(smallShow(6)) as { frames: (StoredFrame & { transition_s?: number })[] };
  const [first] = show.frames;
  if (!first) throw new Error('a frame');
  const turned = first.pixels.map(({ place: [x, y], ...pixel }) => ({ ...pixel, place: [-x, -y] }));
  const motion = { kind: 'turn', turn: Math.PI };
  const frames = [first, { ...first, name: 'Too fast', motion, transition_s: 0.5, pixels: turned }];
  await uploadText(page, 'fast.json', JSON.stringify({ ...show, lightbots: 2, frames }));
  await page.getByRole('tab', { name: 'Show' }).click();
  await page
    .getByText(/the turn takes at least [\d.]+ s, and 0.50 s are asked/)
    .first()
    .waitFor();
});
