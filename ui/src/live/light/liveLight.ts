import type { Operation } from '../../api/types.gen';
import { writeLayer } from '../../model/layers';
import { LIGHT_PRESETS, presetLayer } from '../../model/lightPresets';
import type { Session } from '../../session/session';
import { isPlayed } from '../cueRows';

/** Keys of the presets, in their order. 0 and W are left out, because the floor uses them. */
export const LIGHT_KEYS: readonly string[] = [...'123456789', 'q', 'e', 'd'];

/** How long what was asked for last counts as the state of a light, milliseconds; then what the server says counts. */
const ASKED_FOR_MS = 1_000;

/** Presets over the running show, switched on and off. */
export interface LiveLight {
  /** Puts the preset at `index` over the show, or takes it off. Without a running show nothing happens. */
  press(index: number): void;
  release(title: string): void;
}

type Needs = {
  live: Pick<Session['live'], 'playback' | 'opened'>;
  ask: (operation: Operation) => Promise<unknown>;
};

export function createLiveLight({ live, ask }: Needs, now_ms = () => performance.now()): LiveLight {
  /** What was asked for last, by title: a second press may come before the server has answered the first. */
  const asked = new Map<string, { on: boolean; at_ms: number }>();
  const isOn = (title: string) => {
    const last = asked.get(title);
    if (last && now_ms() - last.at_ms < ASKED_FOR_MS) return last.on;
    return live.playback.get().live_light.includes(title);
  };
  const set = (name: string, layer: Record<string, unknown> | null) => {
    asked.set(name, { on: layer !== null, at_ms: now_ms() });
    void ask({ do: 'live_light', name, layer });
  };
  return {
    press(index) {
      const preset = LIGHT_PRESETS[index];
      const stage = live.opened.get().show?.stage;
      if (!preset || !stage || !isPlayed(live.playback.get().phase)) return;
      const isPressed = isOn(preset.title);
      set(preset.title, isPressed ? null : writeLayer(presetLayer(preset, stage)));
    },
    release: (title) => set(title, null),
  };
}
