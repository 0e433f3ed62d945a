import { expect, test } from 'vitest';
import { assetsOf, pictureAssets, withAssets } from './assets';
import { newShow } from './show';

test('files are added to a show, and pictures among them can be chosen', () => {
  const show = newShow('Test', 2);
  expect(withAssets(show, {})).toBe(show);
  expect(pictureAssets(show)).toEqual([]);
  const logo = { name: 'logo.svg', media_type: 'image/svg+xml', bytes: 7 };
  const sun = { name: 'sun.png', media_type: 'image/png', bytes: 9 };
  const nameless = { media_type: 'image/gif', bytes: 1, more: true };
  const full = withAssets(withAssets(show, { a: logo }), { b: sun, ['c'.repeat(64)]: nameless });
  expect([...assetsOf(full).keys()]).toEqual(['a', 'b', 'c'.repeat(64)]);
  expect(assetsOf(full).get('b')).toEqual(sun);
  expect(pictureAssets(full)).toEqual([
    { hash: 'b', name: 'sun.png' },
    { hash: 'c'.repeat(64), name: 'cccccccc' },
  ]);
  expect(pictureAssets({ ...show, rest: { assets: 'junk' } })).toEqual([]);
});
