import { expect, test } from 'vitest';
import { LAYER_KINDS } from '../model/layerKinds';
import { LIGHT_PRESETS, presetLayer } from '../model/lightPresets';
import { addLayer, setLayerSettings, type Layer } from '../model/layers';
import { EMPTY_STAGE, newFrame, newShow, type Show } from '../model/show';
import { createLights } from './lights';
import type { LightAsk } from './protocol';
import { gifOf } from '../make/gif.testing';
import { realLightWorker } from './realLight.testing';
import { STRIP_MOMENTS, type Strip } from './strip';

const NO_DRIVES = [] as const;
const noFile = () => Promise.reject(new Error('there is no file'));
const layer = (kind: string, settings: Record<string, unknown>): Layer => ({
  kind,
  name: '',
  settings,
  when: { of: 'show' },
  rest: {},
});

/** Two robots in red, then in blue, for 2 s each, under a layer of opaque black. */
function dimmed(): Show {
  const show = newShow('Test', 2);
  const [first] = show.frames;
  const pixels = (color: number) => first?.pixels.map((pixel) => ({ ...pixel, color })) ?? [];
  const frame = (name: string, color: number) => ({
    ...newFrame(name, pixels(color)),
    airTime_s: 2,
  });
  const frames = [frame('A', 0xff0000), frame('B', 0x0000ff)];
  const dark = layer('solid', { palette: ['#000000'], opacity: 1 });
  return addLayer({ ...show, frames }, dark);
}

/** Waits long enough for the module to answer, milliseconds: 250. */
const settled = () => new Promise((done) => setTimeout(done, 250));

test('colours of a moment come once they are computed, and stay the same object', async () => {
  const lights = createLights(() => realLightWorker(), noFile);
  const show = setLayerSettings(dimmed(), 0, { opacity: 0.5 });
  expect(lights.at(show, NO_DRIVES, 1)).toBeNull();
  await settled();
  const red = lights.at(show, NO_DRIVES, 1);
  // Half of the light is 188 of 255 as a code.
  expect([...(red ?? [])]).toEqual([188, 0, 0, 188, 0, 0]);
  expect(lights.at(show, NO_DRIVES, 1)).toBe(red);
  expect(lights.at(show, NO_DRIVES, 1.01)).toBe(red);
  lights.at(show, NO_DRIVES, 3);
  await settled();
  expect([...(lights.at(show, NO_DRIVES, 3) ?? [])]).toEqual([0, 0, 188, 0, 0, 188]);
  expect([...(lights.at(show, NO_DRIVES, 99) ?? [])].length).toBe(6);
});

test('a change of layers alone does not send the show again', async () => {
  const asked: LightAsk['do'][] = [];
  const lights = createLights(() => realLightWorker((ask) => asked.push(ask.do)), noFile);
  const show = dimmed();
  lights.at(show, NO_DRIVES, 0);
  await settled();
  expect([...(lights.at(show, NO_DRIVES, 0) ?? [])]).toEqual([0, 0, 0, 0, 0, 0]);
  const lit = setLayerSettings(show, 0, { opacity: 0 });
  lights.at(lit, NO_DRIVES, 0);
  await settled();
  expect([...(lights.at(lit, NO_DRIVES, 0) ?? [])]).toEqual([255, 0, 0, 255, 0, 0]);
  expect(asked.filter((one) => one === 'load')).toHaveLength(1);
  expect(asked.filter((one) => one === 'relight')).toHaveLength(1);
});

test('a show without layers does not start the module', () => {
  const lights = createLights(() => {
    throw new Error('started');
  }, noFile);
  expect(lights.at(newShow('Test', 2), NO_DRIVES, 0)).toBeNull();
});

test('a module that fails answers nothing any more, and nothing waits for it', async () => {
  let started = 0;
  const lights = createLights(() => {
    started += 1;
    const worker = realLightWorker();
    worker.postMessage = () => worker.onerror?.({} as ErrorEvent);
    return worker;
  }, noFile);
  const preset = presetLayer(LIGHT_PRESETS[0] as (typeof LIGHT_PRESETS)[number], EMPTY_STAGE);
  expect(await lights.strip(preset, EMPTY_STAGE)).toBeNull();
  expect(lights.at(dimmed(), NO_DRIVES, 0)).toBeNull();
  expect(await lights.strip(preset, EMPTY_STAGE)).toBeNull();
  expect(started).toBe(1);
});

/** Number of different colours of a strip over all its moments. */
function colours(strip: Strip): number {
  const all = new Set<number>();
  for (let at = 0; at + 2 < strip.length; at += 3)
    all.add(((strip[at] ?? 0) << 16) | ((strip[at + 1] ?? 0) << 8) | (strip[at + 2] ?? 0));
  return all.size;
}

test('every preset and every effect changes what robots show, by settings that the module takes', async () => {
  const lights = createLights(() => realLightWorker(), noFile);
  const stripOf = async (one: Layer) => {
    const strip = await lights.strip(one, EMPTY_STAGE);
    expect(strip?.length).toBe(STRIP_MOMENTS.count * 96 * 3);
    return strip as Strip;
  };
  const presets = LIGHT_PRESETS.map((preset) => presetLayer(preset, EMPTY_STAGE));
  expect(presets).toHaveLength(12);
  for (const preset of presets)
    expect(colours(await stripOf(preset)), preset.name).toBeGreaterThan(1);
  const plain = await stripOf(layer('no-such-effect', {}));
  expect(colours(plain)).toBe(1);
  for (const kind of Object.keys(LAYER_KINDS).filter(
    (one) => one !== 'picture' && one !== 'sequence',
  )) {
    const strip = await stripOf(layer(kind, {}));
    expect(strip, kind).not.toEqual(plain);
  }
});

/** A picture of 4 × 4 pixels, black with white in the second column. */
const stripe = () => gifOf([1], 4);

test('a picture is fetched and decoded once, and shines then; one that is broken is said', async () => {
  const files: Record<string, Uint8Array> = { good: stripe(), bad: stripe().slice(0, 40) };
  const asked: string[] = [];
  const lights = createLights(
    () => realLightWorker((ask) => asked.push(ask.do)),
    (hash) => {
      const file = files[hash];
      asked.push(`fetch ${hash}`);
      return file ? Promise.resolve(file) : Promise.reject(new Error('it is gone'));
    },
  );
  const projected = (picture: string) => layer('picture', { picture, size_m: 100 });
  const show = addLayer(dimmed(), projected('good'));
  lights.at(show, NO_DRIVES, 1);
  await settled();
  lights.at(show, NO_DRIVES, 1);
  await settled();
  // The robots stand in the middle, where white meets black.
  const lit = [...(lights.at(show, NO_DRIVES, 1) ?? [])];
  expect(lit).toHaveLength(6);
  expect(Math.min(...lit)).toBeGreaterThan(0);
  const strip = await lights.strip(projected('good'), EMPTY_STAGE);
  expect(strip?.some((code) => code > 0)).toBe(true);
  expect(asked.filter((one) => one === 'fetch good')).toHaveLength(1);
  expect(asked.filter((one) => one === 'picture')).toHaveLength(1);
  expect(await lights.strip(projected('bad'), EMPTY_STAGE)).not.toBeNull();
  expect(await lights.strip(projected('gone'), EMPTY_STAGE)).not.toBeNull();
  expect(lights.pictureErrors.get().get('bad')).toContain('damaged or cut off');
  expect(lights.pictureErrors.get().get('gone')).toContain('it is gone');
  expect(lights.pictureErrors.get().has('good')).toBe(false);
});
