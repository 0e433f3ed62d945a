import { useEffect, useMemo } from 'react';
import { useWhyNot } from '../../parts/Gate';
import { useKeys } from '../../parts/useKeys';
import { useSession } from '../../session/session';
import { createLiveLight, LIGHT_KEYS, type LiveLight } from './liveLight';
import { createMidiPads, type MidiPads, type PadAccess } from './midiPads';

/** Live light of this page by button, key and pad. */
export function useLiveLight(): { light: LiveLight; pads: MidiPads } {
  const session = useSession();
  const isRefused = useWhyNot('operator', 'change light') !== null;
  const light = useMemo(() => {
    const all = createLiveLight(session);
    return isRefused ? { ...all, press: () => undefined } : all;
  }, [session, isRefused]);
  const pads = useMemo(() => createMidiPads(midiOfBrowser(), light.press, kept()), [light]);
  useEffect(() => {
    void startIfAllowed(pads);
  }, [pads]);
  useKeys(LIGHT_KEYS.map((key, index) => [key, () => light.press(index)]));
  return { light, pads };
}

function midiOfBrowser(): (() => Promise<PadAccess>) | null {
  // Missing without a safe connection, and in some browsers.
  const { requestMIDIAccess } = navigator as { requestMIDIAccess?: () => Promise<unknown> };
  return requestMIDIAccess
    ? async () => (await requestMIDIAccess.call(navigator)) as PadAccess
    : null;
}

/** Starts without a question where the person allowed MIDI before. */
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
