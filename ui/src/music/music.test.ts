import { expect, test } from 'vitest';
import { withMusic, withoutMusic } from '../model/beats';
import { newShow } from '../model/show';
import { oneChannel, peaksOf, PEAKS_PER_S, type DecodedMusic } from './decode';
import { createMusic } from './music';

const show = newShow('x', 1);
const withFile = (hash: string) =>
  withMusic(show, { hash, name: `${hash}.mp3`, mediaType: 'audio/mpeg', bytes: 1 }, null);
const second = (): DecodedMusic => ({ samples: new Float32Array(1000).fill(0.5), rate_Hz: 1000 });
const bytes = async () => new Uint8Array(1);
const settled = () => new Promise((resolve) => setTimeout(resolve));

test('music is decoded once, also when undo takes it away and brings it back', async () => {
  let decoded = 0;
  const music = createMusic(bytes, async () => (decoded++, second()));
  music.follow(withFile('a'));
  expect(music.state.get().of).toBe('loading');
  await settled();
  const ready = music.state.get();
  expect(ready.of === 'ready' && ready.music.lasts_s).toBe(1);
  music.follow(withoutMusic(withFile('a')));
  expect(music.state.get().of).toBe('none');
  music.follow(withFile('a'));
  expect(music.state.get().of).toBe('ready');
  expect(decoded).toBe(1);
});

test('music that was decoded when it was taken is not decoded again', () => {
  const music = createMusic(bytes, () => Promise.reject(new Error('again')));
  music.add('a', second());
  music.follow(withFile('a'));
  expect(music.state.get().of).toBe('ready');
});

test('what cannot be decoded says why, unless other music is wanted by then', async () => {
  const music = createMusic(bytes, () => Promise.reject(new Error('It is damaged.')));
  music.follow(withFile('a'));
  await settled();
  expect(music.state.get()).toEqual({ of: 'failed', why: 'It is damaged.' });
  music.follow(withFile('b'));
  music.follow(show);
  await settled();
  expect(music.state.get().of).toBe('none');
});

test('channels are mixed, and peaks are shares of the loudest', () => {
  const channels = [new Float32Array([1, 0, -1]), new Float32Array([0, 0, -1])];
  const buffer = {
    numberOfChannels: 2,
    length: 3,
    getChannelData: (i: number) => channels[i] ?? new Float32Array(),
  };
  expect([...oneChannel(buffer)]).toEqual([0.5, 0, -1]);
  const samples = new Float32Array(1000);
  samples[5] = 0.2;
  samples[995] = -0.4;
  const peaks = peaksOf({ samples, rate_Hz: 1000 });
  expect(peaks).toHaveLength(PEAKS_PER_S);
  expect([peaks[0], peaks[50], peaks[99]]).toEqual([0.5, 0, 1]);
  expect([...peaksOf({ samples: new Float32Array(0), rate_Hz: 1000 })]).toEqual([]);
});
