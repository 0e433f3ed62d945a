import { expect, test } from 'vitest';
import { clicks } from './clicks';
import { eventually, openPage } from './harness';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { noteSound, type SoundNotes } from './soundNotes';
import { createTestBed } from './testBed';

const bed = createTestBed('--robots', '4');

const wav = (name: string, buffer: Buffer) => ({ name, mimeType: 'audio/wav', buffer });

async function openMusic(show = smallShow(4, 3)) {
  const page = await bed.open('edit');
  await uploadText(page, 'music.json', show);
  await page.getByRole('tab', { name: 'Show' }).click();
  const music = page.getByRole('region', { name: 'Music' });
  const give = (name: string, buffer: Buffer) =>
    music.locator('input[type=file]').setInputFiles(wav(name, buffer));
  return { page, music, give };
}

test('music is added, its beats are found and corrected, and pictures are arranged to bars', async () => {
  const { page, music, give } = await openMusic();
  await give('clicks.wav', clicks(30));
  const tempo = music.getByLabel('Beats a minute');
  await tempo.waitFor();
  expect(Number(await tempo.inputValue())).toBeCloseTo(120, 0);
  await music.getByRole('button', { name: '÷2' }).click();
  await eventually(
    () => tempo.inputValue(),
    (text) => Math.round(Number(text)) === 60,
    'half',
  );
  await page.keyboard.press('Control+z');
  await eventually(
    () => tempo.inputValue(),
    (text) => Math.round(Number(text)) === 120,
    'undone',
  );

  await music.getByRole('button', { name: 'Arrange to music…' }).click();
  const dialog = page.getByRole('dialog', { name: 'Arrange to music' });
  await dialog.getByText(/air times? would change/).waitFor();
  await dialog.getByRole('button', { name: 'Change air times' }).click();
  await music.getByRole('button', { name: 'Arrange to music…' }).click();
  await dialog.getByText('Every picture begins with a bar already.').waitFor();
  await dialog.getByRole('button', { name: 'Close' }).last().click();

  await music.getByRole('button', { name: 'Hear the music' }).click();
  await music.getByText(/0:0[1-9] of/).waitFor();
  await music.getByRole('button', { name: 'Stop the music' }).click();

  // It is in the library, with the file.
  await page.getByText('Saved', { exact: true }).first().waitFor();
  await page.reload();
  await page.getByRole('tab', { name: 'Show' }).click();
  await music.getByText(/clicks\.wav · 0:30/).waitFor();
});

test('what is no music says why, and loses nothing', async () => {
  const { page, music, give } = await openMusic();
  await give('good.wav', clicks(10));
  await music.getByText(/good\.wav/).waitFor();
  await give('short.wav', clicks(2));
  await page
    .getByText(/The music lasts 2\.0 s\. Beats are found in 4\.0 s or more|lasts 2/)
    .waitFor();
  await music.getByText(/short\.wav/).waitFor();
  await music.getByText('No beats are known.', { exact: false }).waitFor();
  await give('broken.mp3', Buffer.from('ID3\x04\0\0\0\0\0\0 nothing of music'));
  await page.getByText(/Can't use broken\.mp3: This browser cannot play it/).waitFor();
  await give('empty.wav', clicks(10).subarray(0, 44));
  await page.getByText(/Can't use empty\.wav|The music lasts 0\.0 s/).waitFor();
  await music.getByText(/short\.wav|empty\.wav/).waitFor();
  await music.getByRole('button', { name: 'Remove' }).click();
  await button(page, 'Add music…').waitFor();
});

test('on the live page music is in step with the show, and stands with it', async () => {
  const edit = await openMusic(smallShow(4, 6));
  await edit.give('clicks.wav', clicks(40));
  await edit.music.getByText(/clicks\.wav · 0:40/).waitFor();
  await edit.page.getByText('Saved', { exact: true }).first().waitFor();
  const page = await openPage(bed.browser, bed.server, 'live', {}, noteSound);
  const sound = () => page.evaluate(() => (globalThis as unknown as { sound: SoundNotes }).sound);
  await page.getByRole('button', { name: 'Music on this screen' }).click();
  await phaseIs(page, 'ready');
  await button(page, 'Play').click();
  await eventually(sound, ({ ahead_ms }) => ahead_ms.length > 60, 'music for some seconds');
  const { starts, ahead_ms } = await sound();
  expect(starts).toBeLessThanOrEqual(3);
  const sorted = ahead_ms.slice(20).sort((a, b) => a - b);
  const median_ms = sorted[sorted.length >> 1] ?? NaN;
  expect(Math.abs(median_ms)).toBeLessThan(15);
  const { stops } = await sound();
  await button(page, 'Pause').click();
  await eventually(sound, (now) => now.stops > stops, 'music stands in a pause');
  await page.keyboard.press('Escape');
  await page.close();
});
