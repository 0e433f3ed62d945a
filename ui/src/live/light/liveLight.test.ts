import { expect, test, vi } from 'vitest';
import type { Operation } from '../../api/types.gen';
import { createStore } from '../../base/store';
import { LIGHT_PRESETS } from '../../model/lightPresets';
import { newShow } from '../../model/show';
import { createLive } from '../../session/live';
import { createLiveLight, LIGHT_KEYS } from './liveLight';

function setting(phase: 'playing' | 'ready') {
  const live = createLive();
  live.playback.update((p) => ({ ...p, phase }));
  const opened = createStore({ ...live.opened.get(), show: newShow('Waltz', 6) });
  const ask = vi.fn((_: Operation) => Promise.resolve());
  let now_ms = 0;
  const light = createLiveLight({ live: { playback: live.playback, opened }, ask }, () => now_ms);
  return { live, ask, light, pass: (ms: number) => (now_ms += ms) };
}

test('a second press releases a light, also before the server has answered', () => {
  const { light, ask, live, pass } = setting('playing');
  light.press(0);
  light.press(0);
  const sent = ask.mock.calls.map(([operation]) => operation);
  expect(sent[0]).toMatchObject({ do: 'live_light', name: 'Rainbow', layer: { kind: 'rainbow' } });
  expect(sent[1]).toEqual({ do: 'live_light', name: 'Rainbow', layer: null });
  // Another operator switched it on.
  live.playback.update((p) => ({ ...p, live_light: ['Rainbow'] }));
  pass(2_000);
  light.press(0);
  expect(ask.mock.lastCall?.[0]).toEqual({ do: 'live_light', name: 'Rainbow', layer: null });
});

test('without a running show nothing is asked', () => {
  const { light, ask } = setting('ready');
  light.press(0);
  light.press(99);
  expect(ask).not.toHaveBeenCalled();
});

test('each preset has a key of its own', () => {
  expect(new Set(LIGHT_KEYS).size).toBe(LIGHT_PRESETS.length);
});
