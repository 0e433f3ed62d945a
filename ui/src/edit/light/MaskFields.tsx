import { Button, Checkbox, Group, Select, Text } from '@mantine/core';
import { maskChoice, maskOf, maskPixels, MASKS, newMask, type MaskChoice } from '../../model/masks';
import { number, pair, type Json } from '../../model/jsonFields';
import type { Layer } from '../../model/layers';
import { LengthInput } from '../../parts/LengthInput';
import { useEditing, useEditor } from '../context';
import { setSettings } from './lightActs';
import styles from './Light.module.css';

const WORDS: Readonly<Record<MaskChoice | 'other', string>> = {
  all: 'All robots',
  pixels: 'Some pixels',
  circle: 'A circle on the floor',
  rectangle: 'A rectangle on the floor',
  other: 'What the file says',
};

/** Greatest distance from the middle of the floor, and greatest length, metres. */
const FAR_M = 1000;
/** Least radius, width and depth, metres. */
const LEAST_M = 0.01;

/** On which robots or which part of the floor a layer shines. */
export function MaskFields({ index, layer }: { index: number; layer: Layer }) {
  const editing = useEditing();
  const chosen = useEditor((s) => s.selection);
  const choice = maskChoice(layer);
  const mask = maskOf(layer);
  const values = choice === 'other' ? [...MASKS, choice] : MASKS;
  const choose = (value: string | null) => {
    const next = MASKS.find((one) => one === value);
    if (next && next !== choice) setSettings(editing, index, { masks: newMask(next, chosen) });
  };
  const set = (fields: Json) => setSettings(editing, index, { masks: [{ ...mask, ...fields }] });
  return (
    <>
      <Select
        label="Shines on"
        size="xs"
        allowDeselect={false}
        data={values.map((value) => ({ value, label: WORDS[value] }))}
        value={choice}
        onChange={choose}
      />
      {mask && choice === 'pixels' ? <PixelsOf mask={mask} set={set} /> : null}
      {mask && (choice === 'circle' || choice === 'rectangle') ? (
        <AreaOf mask={mask} set={set} isCircle={choice === 'circle'} />
      ) : null}
      {mask && choice !== 'other' ? (
        <Checkbox
          size="sm"
          label="Everywhere else instead"
          checked={mask.inverted === true}
          onChange={(event) => set({ inverted: event.currentTarget.checked })}
        />
      ) : null}
    </>
  );
}

interface Of {
  mask: Json;
  set: (fields: Json) => void;
}

function PixelsOf({ mask, set }: Of) {
  const { editor } = useEditing();
  const chosen = useEditor((s) => s.selection);
  const pixels = maskPixels(mask);
  return (
    <>
      <Text size="xs" c="dimmed" role="status">
        {pixels.length === 0
          ? 'Choose pixels on the floor, then press “Take the chosen”.'
          : `${pixels.length} ${pixels.length === 1 ? 'pixel' : 'pixels'}, in all frames.`}
      </Text>
      <Group gap="xs">
        <Button
          size="compact-xs"
          variant="default"
          disabled={chosen.size === 0}
          onClick={() => set({ pixels: [...chosen] })}
        >
          Take the chosen
        </Button>
        <Button
          size="compact-xs"
          variant="default"
          disabled={pixels.length === 0}
          onClick={() => editor.select(pixels)}
        >
          Choose them
        </Button>
      </Group>
    </>
  );
}

function AreaOf({ mask, set, isCircle }: Of & { isCircle: boolean }) {
  const [x, y] = pair(mask.center);
  const [width, depth] = pair(mask.size_m);
  const length = (label: string, value: number, least: number, to: (metres: number) => Json) => (
    <LengthInput label={label} min={least} max={FAR_M} value={value} onChange={(m) => set(to(m))} />
  );
  return (
    <>
      <div className={styles.pair}>
        {length('Middle x', x, -FAR_M, (to) => ({ center: [to, y] }))}
        {length('Middle y', y, -FAR_M, (to) => ({ center: [x, to] }))}
      </div>
      <div className={styles.pair}>
        {isCircle ? (
          length('Radius', number(mask.radius_m, 0), LEAST_M, (radius_m) => ({ radius_m }))
        ) : (
          <>
            {length('Width', width, LEAST_M, (to) => ({ size_m: [to, depth] }))}
            {length('Depth', depth, LEAST_M, (to) => ({ size_m: [width, to] }))}
          </>
        )}
        {length('Soft edge', number(mask.feather_m, 0), 0, (feather_m) => ({ feather_m }))}
      </div>
    </>
  );
}
