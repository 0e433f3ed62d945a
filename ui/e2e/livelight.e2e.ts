import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { button, countIs, phaseIs, smallShow, uploadText } from './journeys';
import { eventually } from './harness';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '6');

/** Uploads a show with blue lights, opens the tab Light, and plays the show. */
async function play(page: Page, name: string) {
  const show = JSON.parse(smallShow(6, 60)) as { frames: { pixels: { color: string }[] }[] };
  for (const frame of show.frames) for (const pixel of frame.pixels) pixel.color = '#0000ff';
  await uploadText(page, `${name}.json`, JSON.stringify(show));
  await page.getByRole('tab', { name: 'Light' }).click();
  await page.getByText('Press Play first').waitFor();
  await button(page, 'Play').click();
  await phaseIs(page, 'playing');
}

const tile = (page: Page, title: string) => page.getByRole('button', { name: title, exact: true });

const isOn = (page: Page, title: string, on: boolean) =>
  eventually(
    () => tile(page, title).getAttribute('aria-pressed'),
    (pressed) => pressed === String(on),
    `${title} is ${on ? 'on' : 'off'}`,
  );

/** Waits until the lights on the floor are all blue, or none is. */
const areBlue = (page: Page, wanted: boolean) =>
  eventually(
    () => page.getByTestId('robots').locator('li').allTextContents(),
    (lines) => lines.length === 6 && lines.every((line) => line.includes(', blue,') === wanted),
    `the lights are ${wanted ? '' : 'not '}blue`,
  );

test('a light is put over the running show by button, key and pad, and goes with the second press', async () => {
  const page = await bed.open('live');
  // There is no MIDI device: the test plays this one.
  await page.addInitScript(() => {
    const input = {
      name: 'Pads',
      onmidimessage: null as ((e: { data: Uint8Array }) => void) | null,
    };
    const access = { inputs: new Map([['1', input]]), onstatechange: null };
    Object.assign(navigator, { requestMIDIAccess: () => Promise.resolve(access) });
    Object.assign(window, {
      hitPad: (note: number) => input.onmidimessage?.({ data: new Uint8Array([0x90, note, 99]) }),
    });
  });
  await page.reload();
  await play(page, 'live-light');
  await countIs(page.getByRole('list', { name: 'Live light' }).getByRole('listitem'), 12);
  await areBlue(page, true);

  await tile(page, 'Fire').click();
  await isOn(page, 'Fire', true);
  await areBlue(page, false);
  await tile(page, 'Fire').click();
  await isOn(page, 'Fire', false);
  await areBlue(page, true);

  await page.keyboard.press('5');
  await isOn(page, 'Fire', true);
  await areBlue(page, false);
  await page.keyboard.press('5');
  await isOn(page, 'Fire', false);

  await button(page, 'Use MIDI pads').click();
  await page.getByText('MIDI devices: Pads.').waitFor();
  const hit = (note: number) =>
    page.evaluate((n) => (window as unknown as { hitPad: (n: number) => void }).hitPad(n), note);
  await hit(40);
  await isOn(page, 'Fire', true);
  await hit(40);
  await isOn(page, 'Fire', false);
  await page.getByRole('combobox', { name: 'Give a pad to' }).click();
  await page.getByRole('option', { name: 'Sunrise' }).click();
  await page.getByText('Hit the pad that shall press Sunrise.').waitFor();
  await hit(77);
  await page.getByText('MIDI devices: Pads.').waitFor();
  await hit(77);
  await isOn(page, 'Sunrise', true);
  await page.getByRole('tab', { name: 'Light 1' }).waitFor();
  await button(page, 'Take all off').click();
  await isOn(page, 'Sunrise', false);
  await areBlue(page, true);

  // The colour of the lights ends with the show.
  await tile(page, 'Rainbow').click();
  await isOn(page, 'Rainbow', true);
  await page.keyboard.press('Escape');
  await phaseIs(page, 'ready');
  await isOn(page, 'Rainbow', false);
  expect(await tile(page, 'Rainbow').isDisabled()).toBe(true);
});
