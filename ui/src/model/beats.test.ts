import { expect, test } from 'vitest';
import {
  barsLater,
  beatsBetween,
  beatsOf,
  doubled,
  halved,
  musicOf,
  nudged,
  shifted,
  tapped,
  tempoOf,
  withBeats,
  withMusic,
  withoutMusic,
  type Beats,
} from './beats';
import { readShow, writeShow } from './json';
import { newShow } from './show';

const steady: Beats = { grid: { of: 'steady', bpm: 120, offset_s: 0.25 }, perBar: 4 };
const free: Beats = { grid: { of: 'times', times_s: [0, 0.5, 1.1, 1.8] }, perBar: 3 };
const moments = (beats: Beats, to_s = 3) => beatsBetween(beats, 0, to_s).map((b) => b.at_s);

test('beats and music survive the document', () => {
  const file = { hash: 'ab', name: 'march.ogg', mediaType: 'audio/ogg', bytes: 12 };
  for (const beats of [steady, free]) {
    const show = withMusic(newShow('x', 1), file, beats);
    const read = readShow(JSON.parse(JSON.stringify(writeShow(show))));
    expect(beatsOf(read)).toEqual(beats);
    expect(musicOf(read)).toEqual(file);
  }
});

test('music is taken out with its file and its beats, and other files stay', () => {
  const show = newShow('x', 1);
  const other = { cd: { name: 'logo.svg', media_type: 'image/svg+xml', bytes: 3 } };
  const file = { hash: 'ab', name: 'march.ogg', mediaType: 'audio/ogg', bytes: 12 };
  const with_ = withMusic({ ...show, rest: { assets: other } }, file, steady);
  const again = withMusic(with_, { ...file, hash: 'ef', name: 'waltz.ogg' }, null);
  expect(Object.keys(again.rest.assets as object).sort()).toEqual(['cd', 'ef']);
  expect(beatsOf(again)).toBe(null);
  const without = withoutMusic(again);
  expect(without.music).toBe(null);
  expect(without.rest.assets).toEqual(other);
});

test('every fourth beat of a steady tempo begins a bar', () => {
  const found = beatsBetween(steady, 2, 4.3);
  expect(found.map((b) => b.at_s)).toEqual([2.25, 2.75, 3.25, 3.75, 4.25]);
  expect(found.map((b) => b.isBar)).toEqual([true, false, false, false, true]);
  expect(beatsBetween(steady, 0, 1e9, 10)).toHaveLength(10);
});

test('beats without one tempo are counted in bars from the first', () => {
  expect(beatsBetween(free, 0.4, 9)).toEqual([
    { at_s: 0.5, isBar: false },
    { at_s: 1.1, isBar: false },
    { at_s: 1.8, isBar: true },
  ]);
  expect(tempoOf(free)).toBeCloseTo(100);
});

test('twice and half as many, and half a beat later', () => {
  expect(moments(doubled(steady), 1)).toEqual([0.25, 0.5, 0.75, 1]);
  expect(moments(halved(steady))).toEqual([0.25, 1.25, 2.25]);
  expect(moments(shifted(steady, 0.5), 1)).toEqual([0.5, 1]);
  expect(moments(doubled(free))).toEqual([0, 0.25, 0.5, 0.8, 1.1, 1.4500000000000002, 1.8]);
  expect(moments(halved(free))).toEqual([0, 1.1]);
  expect(moments(shifted(free, 0.5)).map((at) => Number(at.toFixed(3)))).toEqual([
    0.25, 0.8, 1.45, 2.15,
  ]);
  expect(moments(halved(doubled(free)))).toEqual(moments(free));
});

test('beats are never before the file', () => {
  expect(moments(nudged(steady, -0.3), 1)[0]).toBeCloseTo(0.45);
  expect(moments(nudged(free, -0.01))).toHaveLength(3);
});

test('the first bar can begin a beat later', () => {
  expect(beatsBetween(barsLater(steady), 0, 1)[0]).toEqual({ at_s: 0.75, isBar: true });
  expect(beatsBetween(barsLater(free), 0, 9)[0]).toEqual({ at_s: 0.5, isBar: true });
});

test('taps that are not exact give a tempo whose bar begins with the first tap', () => {
  const taps = Array.from({ length: 8 }, (_, i) => 10.3 + 0.5 * i + (i % 2 ? 0.01 : -0.01));
  const beats = tapped(taps, 4);
  expect(tempoOf(beats ?? free)).toBeCloseTo(119.4, 0);
  const bars = beatsBetween(beats ?? free, 0, 20).filter((b) => b.isBar);
  expect(Math.min(...bars.map((b) => Math.abs(b.at_s - 10.3)))).toBeLessThan(0.02);
  expect(tapped([1, 2, 3], 4)).toBe(null);
  expect(tapped([1, 1, 1, 1], 4)).toBe(null);
});

test('a show without beats has none, and broken ones are none', () => {
  const show = newShow('x', 1);
  expect(beatsOf(show)).toBe(null);
  expect(beatsOf(withBeats(show, steady))).toEqual(steady);
  expect(beatsOf({ ...show, rest: { beats: { bpm: 'fast' } } })).toBe(null);
});
