import { expect, test, vi } from 'vitest';
import { LIGHT_PRESETS } from '../../model/lightPresets';
import { createMidiPads, type PadAccess, type PadInput } from './midiPads';

function device(name: string): PadInput {
  return { name, onmidimessage: null };
}

function setting(inputs = [device('Pads')], kept: string | null = null) {
  const access: PadAccess = { inputs, onstatechange: null };
  const storage = { getItem: () => kept, setItem: vi.fn() };
  const press = vi.fn();
  const pads = createMidiPads(() => Promise.resolve(access), press, storage);
  const send = (...data: number[]) =>
    inputs.forEach((i) => i.onmidimessage?.({ data: new Uint8Array(data) }));
  return { pads, press, storage, send, inputs, access };
}

test('a pad presses its preset when it is hit, and not when it is let go', async () => {
  const { pads, press, send } = setting();
  await pads.start();
  send(0x99, 38, 100);
  send(0x89, 38, 0);
  send(0x99, 38, 0);
  send(0xb9, 38, 100);
  expect(press.mock.calls).toEqual([[2]]);
  expect(pads.devices.get()).toEqual(['Pads']);
});

test('a preset learns the next pad that is hit, keeps it and has no other', async () => {
  const { pads, press, send, storage } = setting();
  await pads.start();
  for (const note of [60, 61]) {
    pads.learn(5);
    send(0x90, note, 1);
    expect(pads.learning.get()).toBeNull();
  }
  expect(press).not.toHaveBeenCalled();
  send(0x90, 61, 1);
  send(0x90, 60, 1);
  // A pad that means no light does nothing.
  expect(press.mock.calls).toEqual([[5]]);
  expect(storage.setItem).toHaveBeenLastCalledWith('lightbots-pads', '{"61":5}');
});

test('acts beside lights have no pad until one is learned, and every message is heard', async () => {
  const access: PadAccess = { inputs: [device('Pads')], onstatechange: null };
  const [press, hear] = [vi.fn(), vi.fn()];
  const pads = createMidiPads(() => Promise.resolve(access), press, null, { presses: 2, hear });
  await pads.start();
  const send = (...data: number[]) =>
    access.inputs.forEach((input) => input.onmidimessage?.({ data: new Uint8Array(data) }));
  const go = LIGHT_PRESETS.length;
  send(0x90, 36 + go, 100);
  expect(press).not.toHaveBeenCalled();
  pads.learn(go);
  send(0x90, 36 + go, 100);
  send(0x90, 36 + go, 100);
  expect(press.mock.calls).toEqual([[go]]);
  send(0xf1, 0x23);
  expect(hear).toHaveBeenLastCalledWith(new Uint8Array([0xf1, 0x23]));
});

test('devices that come later are heard, and pads that were kept are known', async () => {
  const { pads, press, send, inputs, access } = setting([], '{"70":3,"x":1,"71":"no"}');
  await pads.start();
  expect(pads.devices.get()).toEqual([]);
  inputs.push(device('Late'));
  access.onstatechange?.();
  send(0x90, 70, 9);
  expect(press).toHaveBeenLastCalledWith(3);
  expect(pads.devices.get()).toEqual(['Late']);
});

test('without MIDI, or without leave, the state says so', async () => {
  expect(createMidiPads(null, vi.fn(), null).state.get()).toBe('missing');
  const pads = createMidiPads(() => Promise.reject(new Error('no')), vi.fn(), null);
  await pads.start();
  expect(pads.state.get()).toBe('refused');
});
