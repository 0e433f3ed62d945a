import { expect, test } from 'vitest';
import { writeShow } from './json';
import { newShow } from './show';
import { LINK_CHARS_MAX, packShow, unpackShow } from './showLink';

const DOCUMENT = writeShow(newShow('Grüße an alle', 30));

/** Packs any text in the way that `packShow` packs a document. */
const packText = async (text: string) => {
  const packed = new Blob([text]).stream().pipeThrough(new CompressionStream('deflate-raw'));
  return Buffer.from(await new Response(packed).arrayBuffer()).toString('base64url');
};

test('a show comes out of a link as it went in', async () => {
  const packed = await packShow(DOCUMENT);
  expect(packed).toMatch(/^[A-Za-z0-9_-]+$/);
  const { document, show } = await unpackShow(packed);
  expect(document).toEqual(DOCUMENT);
  expect(show.name).toBe('Grüße an alle');
  expect(show.frames[0]?.pixels).toHaveLength(30);
});

test('a link that was cut off is refused at any length, and so is one with other characters', async () => {
  const packed = await packShow(DOCUMENT);
  for (const length of [0, 1, 2, 3, 5, 100, packed.length - 5, packed.length - 1])
    await expect(unpackShow(packed.slice(0, length))).rejects.toThrow(/damaged or was cut off/);
  for (const wrong of [`${packed}!`, '%E4%F6', '<script>alert(1)</script>', `${packed}=`, 'ÄÖÜ'])
    await expect(unpackShow(wrong)).rejects.toThrow(/damaged or was cut off/);
});

test('what is no show is refused', async () => {
  const others = ['[]', '7', 'null', '{}', '{"lightbots": 1}', '{"lightbots": "1", "frames": []}'];
  for (const text of [...others, '{"lightbots": 1, "frames": {}}', 'no JSON', ''])
    await expect(unpackShow(await packText(text))).rejects.toThrow(/holds no show/);
});

test('a bomb is not unpacked further than the limit', async () => {
  const bomb = await packText(' '.repeat(20_000_000));
  expect(bomb.length).toBeLessThan(LINK_CHARS_MAX);
  await expect(unpackShow(bomb, 1_000_000)).rejects.toThrow(/more than a show may/);
  await expect(unpackShow('A'.repeat(LINK_CHARS_MAX + 1))).rejects.toThrow(/more than a show may/);
});
