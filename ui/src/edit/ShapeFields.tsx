import { Button, Stack } from '@mantine/core';
import {
  IconArrowBigRight,
  IconCircle,
  IconGrain,
  IconGridDots,
  IconHeart,
  IconHexagons,
  IconLine,
  IconPentagon,
  IconRainbow,
  IconRectangle,
  IconScribble,
  IconSpiral,
  IconStar,
  IconTarget,
  IconTimeline,
  IconVectorSpline,
  IconWaveSine,
  type Icon,
} from '@tabler/icons-react';
import type { MakeShape } from '../api/types.gen';
import { useStore } from '../base/store';
import type { ShapeNumber } from '../make/draft';
import type { Making } from '../make/making';
import { ASPECT, SHAPE_NUMBERS } from '../make/shapeNumbers';
import { IconButton } from '../parts/IconButton';
import { ColourField } from './ColourField';
import { PointFields } from './PointFields';
import { SliderField } from './SliderField';
import styles from './Make.module.css';

/** Name, label and icon of each shape. */
const SHAPES: [string, string, Icon][] = [
  ['heart', 'Heart', IconHeart],
  ['star', 'Star', IconStar],
  ['circle', 'Circle', IconCircle],
  ['rings', 'Rings', IconTarget],
  ['rectangle', 'Rectangle', IconRectangle],
  ['polygon', 'Polygon', IconPentagon],
  ['arrow', 'Arrow', IconArrowBigRight],
  ['line', 'Line', IconLine],
  ['polyline', 'Line with corners', IconTimeline],
  ['curve', 'Curve', IconVectorSpline],
  ['freehand', 'Drawn by hand', IconScribble],
  ['wave', 'Wave', IconWaveSine],
  ['arc', 'Arc', IconRainbow],
  ['spiral', 'Spiral', IconSpiral],
  ['grid', 'Grid', IconGridDots],
  ['hexagons', 'Honeycomb', IconHexagons],
  ['random', 'By chance', IconGrain],
];

/** Label, least value, greatest value and step of each slider; angles in degrees. */
const NUMBERS: Record<ShapeNumber, [string, number, number, number]> = {
  aspect: ['Width to height', ASPECT.min, ASPECT.max, 0.1],
  count: ['Corners, tips or circles', 2, 12, 1],
  turns: ['Turns', 0.5, 8, 0.5],
  inner: ['Inner size', 0, 0.95, 0.05],
  span: ['Angle', 10, 360, 5],
};

const DEGREE = Math.PI / 180;

/** A shape and its settings. */
export function ShapeFields({ making, shapes }: { making: Making; shapes: readonly MakeShape[] }) {
  const draft = useStore(making.draft);
  const used = SHAPE_NUMBERS[draft.shape] ?? [];
  const usual = shapes.find((shape) => shape.name === draft.shape);
  const slider = (name: ShapeNumber) => {
    const [label, min, max, step] = NUMBERS[name];
    const unit = name === 'span' ? DEGREE : 1;
    const value = (draft.shapeNumbers[name] ?? usual?.[name] ?? min) / unit;
    const set = (next: number) =>
      making.change({ shapeNumbers: { ...draft.shapeNumbers, [name]: next * unit } });
    return (
      <SliderField
        key={name}
        label={label}
        text={name === 'span' ? `${Math.round(value)}°` : String(Number(value.toFixed(2)))}
        {...{ min, max, step, value }}
        onChange={set}
      />
    );
  };
  return (
    <Stack gap="sm">
      <div className={styles.shapes} role="group" aria-label="Shape">
        {SHAPES.map(([name, label, Glyph]) => (
          <IconButton
            key={name}
            label={label}
            variant="default"
            size="lg"
            w="100%"
            aria-pressed={draft.shape === name}
            onClick={() => making.change({ shape: name, shapeNumbers: {} })}
          >
            <Glyph size={18} />
          </IconButton>
        ))}
      </div>
      <PointFields making={making} />
      {used.map(slider)}
      {draft.shape === 'random' ? (
        <Button size="xs" variant="default" onClick={() => making.change({ seed: draft.seed + 1 })}>
          Other places
        </Button>
      ) : null}
      <ColourField making={making} />
    </Stack>
  );
}
