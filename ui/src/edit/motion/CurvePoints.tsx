import { Button } from '@mantine/core';
import type { Pair } from '../../model/motion';
import { LengthInput } from '../../parts/LengthInput';
import styles from '../light/Light.module.css';

/** Most points of a curve, as docs/show-format.md has it. */
const POINTS_MAX = 200;

interface Props {
  /** What a point is called, such as "Point". */
  name: string;
  along: readonly Pair[];
  onChange: (along: readonly Pair[]) => void;
}

/** The points of a curve, one in a line. */
export function CurvePoints({ name, along, onChange }: Props) {
  const put = (nth: number, point: Pair) =>
    onChange(along.map((one, i) => (i === nth ? point : one)));
  return (
    <>
      {along.map(([x, y], nth) => {
        const label = along.length === 1 ? name : `${name} ${nth + 1}`;
        return (
          <div key={nth} className={styles.pair}>
            <LengthInput label={`${label} x`} value={x} onChange={(to) => put(nth, [to, y])} />
            <LengthInput label={`${label} y`} value={y} onChange={(to) => put(nth, [x, to])} />
          </div>
        );
      })}
      <div className={styles.pair}>
        <Button
          size="compact-xs"
          variant="default"
          disabled={along.length >= POINTS_MAX}
          onClick={() => onChange([...along, next(along)])}
        >
          Add a point
        </Button>
        <Button
          size="compact-xs"
          variant="default"
          disabled={along.length < 2}
          onClick={() => onChange(along.slice(0, -1))}
        >
          Remove the last
        </Button>
      </div>
    </>
  );
}

/** A point beyond the last one, by the step from the point before it to it; a missing point counts as 0, 0. */
function next(along: readonly Pair[]): Pair {
  const [x, y] = along[along.length - 1] ?? [0, 0];
  const [fromX, fromY] = along[along.length - 2] ?? [0, 0];
  return [2 * x - fromX, 2 * y - fromY];
}
