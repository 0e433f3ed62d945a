import { Select } from '@mantine/core';
import { framesOf, type Layer, type LayerPhase } from '../../model/layers';
import { NumberField } from '../../parts/NumberField';
import { ChoiceField } from '../ChoiceField';
import { useEditing, useEditor } from '../context';
import { setFields, setFrames, setPhase } from './lightActs';
import styles from './Light.module.css';

const OF = ['show', 'frames', 'seconds'] as const;
const OF_WORDS = { show: 'Whole show', frames: 'Frames', seconds: 'Seconds' } as const;
const PHASES = ['whole', 'picture', 'transition'] as const;
const PHASE_WORDS = { whole: 'All of it', picture: 'Air time', transition: 'Drive' } as const;

/** When a layer shines: over the whole show, in frames or parts of them, or between two moments of show time. */
export function WhenFields({ index, layer }: { index: number; layer: Layer }) {
  const editing = useEditing();
  const { when } = layer;
  const choose = (of: (typeof OF)[number]) => {
    if (of === when.of) return;
    if (of === 'show') setFields(editing, index, { when: { of } });
    else if (of === 'frames') setPhase(editing, index, 'whole');
    else setFields(editing, index, { when: { of, from_s: 0, to_s: 5 } });
  };
  return (
    <>
      <ChoiceField
        label="Shines in"
        value={when.of}
        values={OF}
        labels={OF_WORDS}
        onChange={choose}
      />
      {when.of === 'frames' ? (
        <FramesFields index={index} layer={layer} phase={when.phase} />
      ) : null}
      {when.of === 'seconds' ? (
        <div className={styles.pair}>
          <NumberField
            label="From (s)"
            description="of show time"
            unit=" s"
            min={0}
            max={when.to_s}
            digits={2}
            step={0.5}
            value={when.from_s}
            onChange={(from_s) => setFields(editing, index, { when: { ...when, from_s } })}
          />
          <NumberField
            label="To (s)"
            description="0: first air time"
            unit=" s"
            min={when.from_s}
            max={86_400}
            digits={2}
            step={0.5}
            value={when.to_s}
            onChange={(to_s) => setFields(editing, index, { when: { ...when, to_s } })}
          />
        </div>
      ) : null}
    </>
  );
}

function FramesFields({ index, layer, phase }: { index: number; layer: Layer; phase: LayerPhase }) {
  const editing = useEditing();
  const show = useEditor((s) => s.show);
  const [first, last] = framesOf(show, layer) ?? [0, 0];
  const frames = show.frames.map((frame, i) => ({
    value: String(i),
    label: `${i + 1} ${frame.name}`.trim(),
  }));
  const frame = (
    label: string,
    value: number,
    to: (frame: number) => readonly [number, number],
  ) => (
    <Select
      label={label}
      size="xs"
      style={{ flex: 1 }}
      allowDeselect={false}
      data={frames}
      value={String(value)}
      onChange={(chosen) => chosen !== null && setFrames(editing, index, to(Number(chosen)), phase)}
    />
  );
  return (
    <>
      <div className={styles.pair}>
        {frame('From frame', first, (chosen) => [chosen, Math.max(chosen, last)])}
        {frame('To frame', last, (chosen) => [Math.min(first, chosen), chosen])}
      </div>
      <ChoiceField
        label="Part of the frames"
        value={phase}
        values={PHASES}
        labels={PHASE_WORDS}
        onChange={(next) => setPhase(editing, index, next)}
      />
    </>
  );
}
