import { Button, Select } from '@mantine/core';
import { useStore } from '../../base/store';
import { LIGHT_PRESETS } from '../../model/lightPresets';
import type { MidiPads, PadsState } from './midiPads';
import { PAD_ACTS } from './padActs';
import styles from './LightTab.module.css';

const STATES: Record<Exclude<PadsState, 'on'>, string> = {
  off: 'Pads of a MIDI device can press these lights.',
  asking: 'Answer the question of the browser about MIDI devices.',
  refused:
    'The browser was not allowed to use MIDI devices. Allow it in the settings of this page, and try again.',
  missing:
    'This browser has no MIDI here. It needs Chrome, Edge or Firefox, and an address with https or on this computer.',
};

const TITLES = [...LIGHT_PRESETS, ...PAD_ACTS].map(({ title }) => title);
const CHOICES = TITLES.map((label, index) => ({ value: String(index), label }));

/** MIDI pads: a button that asks for them, then which devices are there, and a field that gives a light a pad. */
export function PadFields({ pads }: { pads: MidiPads }) {
  const state = useStore(pads.state);
  const devices = useStore(pads.devices);
  const learning = useStore(pads.learning);
  if (state !== 'on')
    return (
      <div className={styles.pads}>
        <p className={`quiet ${styles.line}`} role="status">
          {STATES[state]}
        </p>
        {state === 'missing' ? null : (
          <Button
            size="compact-sm"
            variant="default"
            loading={state === 'asking'}
            onClick={() => void pads.start()}
          >
            Use MIDI pads
          </Button>
        )}
      </div>
    );
  const names = devices.length === 0 ? 'none is connected' : devices.join(', ');
  return (
    <div className={styles.pads}>
      <p className={`quiet ${styles.line}`} role="status">
        {learning === null
          ? `MIDI devices: ${names}. Twelve pads from note 36 on press the lights in their order.`
          : `Hit the pad that shall press ${TITLES[learning] ?? ''}.`}
      </p>
      <Select
        size="xs"
        label="Give a pad to"
        placeholder="Choose a light, GO or Stop all"
        data={CHOICES}
        value={learning === null ? null : String(learning)}
        clearable
        onChange={(value) => pads.learn(value === null ? null : Number(value))}
      />
    </div>
  );
}
