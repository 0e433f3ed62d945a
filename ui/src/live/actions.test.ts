import { expect, test } from 'vitest';
import type { Phase, Playback } from '../api/types.gen';
import { actionsOf, asksToGoOn, phaseText, takesGo } from './actions';

const playback = (phase: Phase): Playback => ({
  phase,
  doing: null,
  frame: 1,
  next: 2,
  live_light: [],
  may_jump: false,
  frames: 12,
  progress: 0,
  left_s: null,
  failure: null,
  looping: false,
  speed_percent: 100,
  first_run: false,
  stopped_in: null,
  preflight: null,
  cue: null,
  repeats: null,
  may_go_on: false,
  late: [],
});

test.each<[Phase, string, string]>([
  ['idle', 'play', 'loop'],
  ['ready', 'play', 'loop refresh play preview home jump'],
  ['preparing', 'play', 'loop refresh abort'],
  ['playing', 'pause', 'loop refresh pause abort'],
  ['paused', 'resume', 'loop refresh resume step abort'],
  ['preview', 'play', 'loop refresh abort'],
  ['aborting', 'play', 'loop refresh'],
  ['link_lost', 'go_on', 'loop refresh abort'],
])('%s offers %s, and %s work', (phase, main, enabled) => {
  const actions = actionsOf(phase, true, true);
  expect(actions.main).toBe(main);
  expect([...actions.enabled].join(' ')).toBe(enabled);
});

test('robots that stand are sent to another frame, and the next one is skipped', () => {
  const { enabled } = actionsOf('playing', true, true, false, false, true);
  expect(enabled.has('jump') && enabled.has('skip')).toBe(true);
});

test('without a server nothing works, without a show nothing plays', () => {
  expect(actionsOf('ready', false, true).enabled.size).toBe(0);
  expect(actionsOf('ready', true, false).enabled.has('play')).toBe(false);
});

test('a show that stands still goes on once robots report', () => {
  expect(actionsOf('link_lost', true, true, true).enabled.has('go_on')).toBe(true);
});

test('the operator is asked once only the operator is waited for', () => {
  const lost = playback('link_lost');
  expect(asksToGoOn({ ...lost, doing: 'waiting for robots to report' })).toBe(false);
  expect(asksToGoOn({ ...lost, doing: 'waiting for you to go on' })).toBe(true);
});

test('words', () => {
  expect(phaseText(playback('playing'))).toBe('Playing frame 2 of 12');
  expect(phaseText({ ...playback('paused'), frame: null })).toBe('Paused');
  expect(phaseText(playback('preview'))).toBe('Driving to frame 2 of 12');
  const preflight = {
    doing: 'driving out',
    round: 1,
    rounds: 1,
    finished: false,
    passed: 0,
    named: 0,
  };
  expect(phaseText({ ...playback('preview'), frame: null, preflight })).toBe(
    'Preflight: driving out',
  );
  expect(phaseText(playback('link_lost'))).toBe('Link lost');
  expect(phaseText({ ...playback('link_lost'), doing: 'waiting for you to go on' })).toBe(
    'Link lost, waiting for you to go on',
  );
  expect(phaseText(playback('ready'))).toBe('Ready');
  const failure = 'Show stopped in frame 1: all 20 robots lost contact.';
  expect(phaseText({ ...playback('ready'), failure }), 'a dead show is not ready').toBe(
    'Show stopped',
  );
  expect(phaseText({ ...playback('aborting'), failure }), 'while its robots are stopped').toBe(
    'Show stopped',
  );
});

test('GO is there while a frame waits for it, but not in a pause', () => {
  expect(actionsOf('playing', true, true, false, true).enabled.has('go')).toBe(true);
  expect(actionsOf('paused', true, true, false, true).enabled.has('go')).toBe(false);
  expect(phaseText({ ...playback('playing'), doing: 'waiting for GO' })).toBe(
    'Waiting for GO, frame 2 of 12',
  );
});

test('GO is taken by a frame that waits, and by frames that repeat until it was given', () => {
  const repeats = { first: 1, last: 2, round: 3, leaves: false };
  expect(takesGo({ cue: null, repeats: null })).toBe(false);
  expect(takesGo({ cue: '', repeats: null })).toBe(true);
  expect(takesGo({ cue: null, repeats })).toBe(true);
  expect(takesGo({ cue: null, repeats: { ...repeats, leaves: true } })).toBe(false);
});
