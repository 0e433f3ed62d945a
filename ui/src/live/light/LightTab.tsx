import { Button, Group } from '@mantine/core';
import { useEffect, useMemo } from 'react';
import { getAsset } from '../../api/http';
import { useStore } from '../../base/store';
import { startLightWorker } from '../../light/browserWorker';
import { createLights } from '../../light/lights';
import { PresetTiles } from '../../light/PresetTiles';
import { LIGHT_PRESETS } from '../../model/lightPresets';
import { Gate } from '../../parts/Gate';
import { useSession } from '../../session/session';
import { isPlayed } from '../cueRows';
import { LIGHT_KEYS, type LiveLight } from './liveLight';
import { TimeCodeFields } from '../midi/TimeCodeFields';
import type { LiveTimeCode } from '../midi/useTimeCode';
import type { MidiPads } from './midiPads';
import { PadFields } from './PadFields';
import styles from './LightTab.module.css';

interface Props {
  light: LiveLight;
  pads: MidiPads;
  code: LiveTimeCode;
}

/** Presets that a press puts over the running show and a second press takes off; fields for MIDI pads and time code. */
export default function LightTab({ light, pads, code }: Props) {
  const { live } = useSession();
  const stage = useStore(live.opened, (o) => o.show?.stage ?? null);
  const plays = useStore(live.playback, (p) => isPlayed(p.phase));
  // A text, not the list, which may be another object with each message.
  const names = useStore(live.playback, (p) => JSON.stringify(p.live_light));
  const on = useMemo(() => JSON.parse(names) as string[], [names]);
  const learning = useStore(pads.learning);
  const midi = useStore(pads.state);
  const lights = useMemo(() => createLights(startLightWorker, getAsset), []);
  useEffect(() => () => lights.end(), [lights]);
  if (!stage) return <p className={`quiet ${styles.text}`}>No show is open. Open one first.</p>;
  const others = on.filter((name) => !LIGHT_PRESETS.some((preset) => preset.title === name));
  return (
    <Gate needs="operator" act="change light">
      <p className={`quiet ${styles.text}`}>
        {plays
          ? 'A press puts a light over the show, a second press takes it off.'
          : 'Press Play first: these lights lie over a running show.'}
      </p>
      <div className={styles.tiles}>
        <PresetTiles
          label="Live light"
          lights={lights}
          stage={stage}
          disabled={!plays && learning === null}
          isOn={(title) => on.includes(title)}
          keyOf={(index) => LIGHT_KEYS[index]}
          onPress={(index) => (learning === null ? light.press(index) : pads.learn(index))}
        />
        <Group gap="xs">
          {others.map((name) => (
            <Button
              key={name}
              size="compact-sm"
              variant="default"
              onClick={() => light.release(name)}
            >
              Take off {name}
            </Button>
          ))}
          <Button
            size="compact-sm"
            variant="default"
            disabled={on.length === 0}
            onClick={() => on.forEach(light.release)}
          >
            Take all off
          </Button>
        </Group>
        <PadFields pads={pads} />
        <TimeCodeFields code={code} midi={midi} />
      </div>
    </Gate>
  );
}
