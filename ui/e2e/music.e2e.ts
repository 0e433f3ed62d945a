import { expect, test } from 'vitest';
import { eventually, openPage } from './harness';
import { button, phaseIs, smallShow, uploadText } from './journeys';
import { createTestBed } from './testBed';

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

/** Notes when music is started and stopped, and how far it is ahead of the show, as the sound device says. */
function noteSound() {
  const sound = { starts: 0, stops: 0, ahead_ms: [] as number[] };
  Object.assign(globalThis, { sound });
  let since: { node: AudioBufferSourceNode; at_s: number; from_s: number; rate: number } | null =
    null;
  const { start, stop } = AudioBufferSourceNode.prototype;
  AudioBufferSourceNode.prototype.start = function (at_s = 0, from_s = 0) {
    sound.starts++;
    since = { node: this, at_s, from_s, rate: 1 };
    start.call(this, at_s, from_s);
  };
  AudioBufferSourceNode.prototype.stop = function () {
    sound.stops++;
    since = null;
    stop.call(this);
  };
  // The page's own message handler is not used: the difference of clocks is taken from the quickest message.
  let [offset_ms, handled] = [Infinity, 0];
  const RealSocket = globalThis.WebSocket;
  globalThis.WebSocket = class extends RealSocket {
    constructor(...more: ConstructorParameters<typeof RealSocket>) {
      super(...more);
      this.addEventListener('message', ({ data }) => {
        if (typeof data !== 'string' || !data.includes('"show_time"')) return;
        const { at_ms, show_time } = JSON.parse(data) as {
          at_ms: number;
          show_time: { show_s: number; runs: boolean } | null;
        };
        const now_ms = performance.now();
        offset_ms = Math.min(offset_ms, now_ms - at_ms);
        if (!since || !show_time?.runs || ++handled < 40) return;
        const { contextTime = 0, performanceTime = 0 } = (
          since.node.context as AudioContext
        ).getOutputTimestamp();
        const heard_s = contextTime + (now_ms - performanceTime) / 1000;
        if (heard_s < since.at_s) return;
        const show_s = show_time.show_s + (now_ms - offset_ms - at_ms) / 1000;
        const position_s = since.from_s + (heard_s - since.at_s) * since.rate;
        // The player makes it a little faster or slower.
        const rate = since.node.playbackRate.value;
        if (rate !== since.rate) since = { ...since, at_s: heard_s, from_s: position_s, rate };
        sound.ahead_ms.push(1000 * (position_s - show_s));
      });
    }
  };
}

test('on the live page music is in step with the show, and stands with it', async () => {
  const edit = await openMusic(smallShow(4, 6));
  await edit.give('clicks.wav', clicks(40));
  await edit.music.getByText(/clicks\.wav · 0:40/).waitFor();
  await edit.page.getByText('Saved', { exact: true }).first().waitFor();
  const page = await openPage(bed.browser, bed.server, 'live', {}, noteSound);
  const sound = () =>
    page.evaluate(
      () =>
        (globalThis as unknown as { sound: { starts: number; stops: number; ahead_ms: number[] } })
          .sound,
    );
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
