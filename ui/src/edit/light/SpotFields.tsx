import { Select, Text } from '@mantine/core';
import { ALONGS, alongOf, isUsed, numberOf, placeOf, type Along } from '../../model/layerKinds';
import type { Layer } from '../../model/layers';
import { LAYER_KINDS } from '../../model/layerKinds';
import { AngleField } from '../../parts/AngleField';
import { LengthInput } from '../../parts/LengthInput';
import { useEditing } from '../context';
import { setSettings } from './lightActs';
import styles from './Light.module.css';

const ALONG_WORDS: Readonly<Record<Along, string>> = {
  line: 'A direction on the floor',
  distance: 'The distance from a place',
  angle: 'Around a place',
  order: 'The order of robots',
  curve: 'A curve',
};

/** Greatest distance from the middle of the floor, and greatest span, metres, as docs/light.md has them. */
const FAR_M = 1000;

/** Where a layer starts, its direction and its span; the stage has handles for them. */
export function SpotFields({ index, layer }: { index: number; layer: Layer }) {
  const editing = useEditing();
  const along = alongOf(layer.settings);
  const { x, y } = placeOf(layer);
  const set = (settings: Record<string, unknown>) => setSettings(editing, index, settings);
  const runs = LAYER_KINDS[layer.kind]?.settings.includes('along') ?? false;
  // The screen keeps a curve that is in the file, but cannot draw one.
  const ways = ALONGS.filter((way) => way !== 'curve' || along === 'curve');
  return (
    <>
      {runs ? (
        <Select
          label="Runs along"
          size="xs"
          allowDeselect={false}
          data={ways.map((value) => ({ value, label: ALONG_WORDS[value] }))}
          value={along}
          onChange={(value) => set({ along: value ?? undefined })}
        />
      ) : null}
      {isUsed(layer, 'place') ? (
        <>
          <Text size="xs" c="dimmed">
            Drag the circle and the square on the floor, or type:
          </Text>
          <div className={styles.pair}>
            <LengthInput
              label="From x"
              min={-FAR_M}
              max={FAR_M}
              value={x}
              onChange={(to) => set({ place: [to, y] })}
            />
            <LengthInput
              label="From y"
              min={-FAR_M}
              max={FAR_M}
              value={y}
              onChange={(to) => set({ place: [x, to] })}
            />
          </div>
        </>
      ) : null}
      <div className={styles.pair}>
        {isUsed(layer, 'size_m') ? (
          <LengthInput
            label="Span"
            min={0.01}
            max={FAR_M}
            value={numberOf(layer, 'size_m')}
            onChange={(size_m) => set({ size_m })}
          />
        ) : null}
        {isUsed(layer, 'angle') ? (
          <AngleField
            label="Direction"
            most={360}
            value={numberOf(layer, 'angle')}
            onChange={(angle) => set({ angle: Math.round(angle * 1e4) / 1e4 })}
          />
        ) : null}
      </div>
    </>
  );
}
