import { expect, test } from 'vitest';
import { button, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';
import { eventually } from './harness';

const bed = createTestBed('--robots', '4');

const RATE_HZ = 8000;

/** Clicks at 120 beats a minute as a WAV file, from 0.25 s on; every fourth is a low one. */
function clicks(lasts_s: number): Buffer {
  const samples = new Int16Array(lasts_s * RATE_HZ);
  for (let beat = 0; 0.25 + beat / 2 < lasts_s - 0.1; beat++) {
    const [first, hz] = [Math.round((0.25 + beat / 2) * RATE_HZ), beat % 4 === 0 ? 100 : 1500];
    for (let i = 0; i < 400; i++)
      samples[first + i] = 24_000 * Math.sin((2 * Math.PI * hz * i) / RATE_HZ) * Math.exp(-i / 120);
  }
  const header = Buffer.alloc(44);
  header.write('RIFF', 0);
  header.writeUInt32LE(36 + samples.byteLength, 4);
  header.write('WAVEfmt ', 8);
  header.writeUInt32LE(16, 16);
  header.writeUInt16LE(1, 20);
  header.writeUInt16LE(1, 22);
  header.writeUInt32LE(RATE_HZ, 24);
  header.writeUInt32LE(2 * RATE_HZ, 28);
  header.writeUInt16LE(2, 32);
  header.writeUInt16LE(16, 34);
  header.write('data', 36);
  header.writeUInt32LE(samples.byteLength, 40);
  return Buffer.concat([header, Buffer.from(samples.buffer)]);
}

const wav = (name: string, buffer: Buffer) => ({ name, mimeType: 'audio/wav', buffer });

async function openMusic() {
  const page = await bed.open('edit');
  await uploadText(page, 'music.json', smallShow(4, 3));
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
  await dialog.getByRole('button', { name: 'Close' }).click();

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
