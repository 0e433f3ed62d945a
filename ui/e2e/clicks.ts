/** Samples a second. */
const RATE_HZ = 8000;

/** A WAV file of `lasts_s` seconds: clicks at 120 a minute from `FIRST_S` on; the 1st, 5th, 9th … are low. */
export function clicks(lasts_s: number): Buffer {
  const samples = new Int16Array(lasts_s * RATE_HZ);
  for (let beat = 0; FIRST_S + beat / 2 < lasts_s - 0.1; beat++) {
    const first = Math.round((FIRST_S + beat / 2) * RATE_HZ);
    const hz = beat % 4 === 0 ? 100 : 1500;
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

/** When the first click begins, seconds. */
export const FIRST_S = 0.25;
/** Time between two clicks, seconds. */
export const EVERY_S = 0.5;
