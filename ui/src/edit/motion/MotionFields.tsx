import { Text } from '@mantine/core';
import type { Motion, Pair } from '../../model/motion';
import { AngleField } from '../../parts/AngleField';
import { LengthInput } from '../../parts/LengthInput';
import { NumberField } from '../../parts/NumberField';
import styles from '../light/Light.module.css';
import { CurvePoints } from './CurvePoints';
import { Percent, Times } from './MotionNumbers';

type Set = (motion: Motion) => void;

/** The settings of a motion. */
export function MotionFields({ motion, set }: { motion: Motion; set: Set }) {
  switch (motion.kind) {
    case 'travel':
    case 'follow':
      return (
        <CurvePoints
          name={motion.kind === 'travel' ? 'Move' : 'Point'}
          along={motion.along}
          onChange={(along) => set({ ...motion, along })}
        />
      );
    case 'turn':
      return (
        <>
          <CenterFields center={motion.center} onChange={(center) => set({ ...motion, center })} />
          <div className={styles.pair}>
            <AngleField
              label="Turn"
              most={5700}
              value={motion.turn}
              onChange={(turn) => set({ ...motion, turn })}
            />
            <Percent value={motion.size} onChange={(size) => set({ ...motion, size })} />
          </div>
        </>
      );
    case 'breathe':
      return (
        <>
          <CenterFields center={motion.center} onChange={(center) => set({ ...motion, center })} />
          <div className={styles.pair}>
            <Percent value={motion.size} onChange={(size) => set({ ...motion, size })} />
            <Times value={motion.times} onChange={(times) => set({ ...motion, times })} />
          </div>
        </>
      );
    case 'wave':
      return <WaveFields motion={motion} set={set} />;
    case 'stagger':
      return (
        <div className={styles.pair}>
          <AngleField
            label="Direction"
            most={360}
            value={motion.direction}
            onChange={(direction) => set({ ...motion, direction })}
          />
          <NumberField
            label="Spread (s)"
            unit=" s"
            min={0}
            max={600}
            digits={2}
            step={0.5}
            value={motion.delay_s}
            onChange={(delay_s) => set({ ...motion, delay_s })}
          />
        </div>
      );
    case 'morph':
      return (
        <Text size="xs" c="dimmed">
          Pictures in between: {motion.through.length}
        </Text>
      );
  }
}

function WaveFields({ motion, set }: { motion: Motion & { kind: 'wave' }; set: Set }) {
  return (
    <>
      <div className={styles.pair}>
        <LengthInput
          label="Radius"
          min={0.001}
          value={motion.radius_m}
          onChange={(radius_m) => set({ ...motion, radius_m })}
        />
        <LengthInput
          label="Wavelength"
          min={0.001}
          value={motion.length_m}
          onChange={(length_m) => set({ ...motion, length_m })}
        />
      </div>
      <div className={styles.pair}>
        <AngleField
          label="Direction"
          most={360}
          value={motion.direction}
          onChange={(direction) => set({ ...motion, direction })}
        />
        <Times value={motion.times} onChange={(times) => set({ ...motion, times })} />
      </div>
    </>
  );
}

function CenterFields({ center, onChange }: { center: Pair; onChange: (center: Pair) => void }) {
  const [x, y] = center;
  return (
    <div className={styles.pair}>
      <LengthInput label="About x" value={x} onChange={(to) => onChange([to, y])} />
      <LengthInput label="About y" value={y} onChange={(to) => onChange([x, to])} />
    </div>
  );
}
