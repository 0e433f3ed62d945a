import type { ReactNode } from 'react';
import styles from './Timeline.module.css';

/** A row of the timeline above the layers of light. */
export interface TimelineRow {
  title: string;
  icon?: ReactNode;
  height: 'ruler' | 'marks' | 'frames' | 'music';
  /** What lies beside the name, as wide as the whole timeline. */
  lane: ReactNode;
}

interface Props {
  rows: readonly TimelineRow[];
  /** Width of the lanes, CSS pixels. */
  width: number;
  /** What lies over all lanes. */
  children: ReactNode;
}

/** Rows with their names at the left, in one sticky column, because each sticky element costs drawing time. */
export const Rows = ({ rows, width, children }: Props) => (
  <>
    <div className={styles.names} data-names>
      {rows.map(({ title, icon, height }) => (
        <div key={title} className={styles.name} data-height={height} title={title}>
          {icon}
          <span>{title}</span>
        </div>
      ))}
    </div>
    <div className={styles.lanes} style={{ width }}>
      {rows.map(({ title, height, lane }) => (
        <div key={title} className={styles.lane} data-height={height}>
          {lane}
        </div>
      ))}
      {children}
    </div>
  </>
);
