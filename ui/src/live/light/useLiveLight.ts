import { useEffect, useMemo } from 'react';
import { LIGHT_PRESETS } from '../../model/lightPresets';
import { useWhyNot } from '../../parts/Gate';
import { useKeys } from '../../parts/useKeys';
import { useSession } from '../../session/session';
import { createLiveLight, LIGHT_KEYS, type LiveLight } from './liveLight';
import { useTimeCode, type LiveTimeCode } from '../midi/useTimeCode';
import { createMidiPads, type MidiPads, type PadAccess } from './midiPads';
import { PAD_ACTS } from './padActs';

/** Live light of this page by button, key and MIDI pad, and time code of MIDI devices. */
export function useLiveLight(): { light: LiveLight; pads: MidiPads; code: LiveTimeCode } {
  const session = useSession();
  const isRefused = useWhyNot('operator', 'change light') !== null;
  const light = useMemo(() => {
    const all = createLiveLight(session);
    return isRefused ? { ...all, press: () => undefined } : all;
  }, [session, isRefused]);
  const code = useTimeCode(!isRefused);
  const pads = useMemo(() => {
    const press = (index: number) => {
      const act = PAD_ACTS[index - LIGHT_PRESETS.length];
      if (act) void session.ask(act.operation);
      else light.press(index);
    };
    return createMidiPads(midiOfBrowser(), press, kept(), {
      presses: PAD_ACTS.length,
      hear: code.hear,
    });
  }, [light, code, session]);
  useEffect(() => {
    void startIfAllowed(pads);
  }, [pads]);
  useKeys(LIGHT_KEYS.map((key, index) => [key, () => light.press(index)]));
  return { light, pads, code };
}

function midiOfBrowser(): (() => Promise<PadAccess>) | null {
  // Missing without a safe connection, and in some browsers.
  const { requestMIDIAccess } = navigator as { requestMIDIAccess?: () => Promise<unknown> };
  return requestMIDIAccess
    ? async () => (await requestMIDIAccess.call(navigator)) as PadAccess
    : null;
}

/** Starts MIDI if the browser says that the user allowed it before, so that no question appears. */
async function startIfAllowed(pads: MidiPads) {
  try {
    const { state } = await navigator.permissions.query({ name: 'midi' as PermissionName });
    if (state === 'granted') await pads.start();
  } catch {
    // The browser cannot say; the button asks.
  }
}

function kept(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;
  }
}
