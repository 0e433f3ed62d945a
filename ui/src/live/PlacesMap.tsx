import type { Stage } from '../model/show';
import type { Comparison } from '../session/places';
import styles from './PlacesMap.module.css';

/** The floor with free starting places as rings, robots in theirs, and robots elsewhere with a line to their goal. */
export function PlacesMap({ stage, found }: { stage: Stage; found: Comparison }) {
  const { width_m, depth_m, radius_m } = stage;
  const { inPlace, away, free } = found;
  // The y axis of a picture points down.
  return (
    <svg
      className={styles.map}
      viewBox={`${-width_m / 2} ${-depth_m / 2} ${width_m} ${depth_m}`}
      role="img"
      aria-label="Robots and starting places on the floor"
    >
      {free.map(({ x, y }, i) => (
        <circle key={i} className={styles.place} cx={x} cy={-y} r={radius_m} />
      ))}
      {inPlace.map(({ name, at }) => (
        <circle key={name} className={styles.in} cx={at.x} cy={-at.y} r={radius_m} />
      ))}
      {away.map(({ name, at, goal }) => (
        <g key={name}>
          {goal ? (
            <>
              <circle className={styles.place} cx={goal.x} cy={-goal.y} r={radius_m} />
              <line className={styles.way} x1={at.x} y1={-at.y} x2={goal.x} y2={-goal.y} />
            </>
          ) : null}
          <circle className={styles.away} cx={at.x} cy={-at.y} r={radius_m} />
        </g>
      ))}
    </svg>
  );
}
