import { useMemo } from 'react';
import { PEAKS_PER_S } from '../../music/decode';
import type { Beat } from '../../model/beats';
import styles from './Music.module.css';

interface Props {
  peaks: Float32Array;
  beats: readonly Beat[];
  /** The stretch of the file that is drawn, seconds. */
  from_s: number;
  to_s: number;
  /** The position that is heard, seconds; null: none. */
  at_s: number | null;
  /** Steps of the drawing from left to right; it is stretched to the element's width. */
  columns?: number;
  /** Called when the drawing is pressed, with the position in the file, seconds. */
  onSeek?: (at_s: number) => void;
}

/** Columns of a drawing where none are given. */
const COLUMNS = 600;
/** Height of the drawing, in units of the picture. */
const HEIGHT = 60;
/** If beats are nearer to each other than this on average, in columns, only the bars are drawn. */
const DENSE = 5;

/** Loudness over time, with lines at bars and beats. */
export function Waveform(props: Props) {
  const { peaks, beats, from_s, to_s, at_s, columns = COLUMNS, onSeek } = props;
  const wave = useMemo(
    () => wavePath(peaks, from_s, to_s, columns),
    [peaks, from_s, to_s, columns],
  );
  const [bars, others] = useMemo(() => {
    const isDense = beats.length * DENSE > columns;
    const lines = (some: readonly Beat[]) =>
      some.map((b) => `M${column(b.at_s, from_s, to_s, columns)} 0V${HEIGHT}`).join('');
    return [
      lines(beats.filter((b) => b.isBar)),
      isDense ? '' : lines(beats.filter((b) => !b.isBar)),
    ];
  }, [beats, from_s, to_s, columns]);
  const head = at_s === null ? null : column(at_s, from_s, to_s, columns);
  return (
    <svg
      className={styles.wave}
      viewBox={`0 0 ${columns} ${HEIGHT}`}
      preserveAspectRatio="none"
      aria-hidden
      onPointerDown={(event) => {
        const box = event.currentTarget.getBoundingClientRect();
        const share = (event.clientX - box.left) / Math.max(1, box.width);
        onSeek?.(from_s + share * (to_s - from_s));
      }}
    >
      <path className={styles.peaks} d={wave} />
      <path className={styles.beats} d={others} />
      <path className={styles.bars} d={bars} />
      {head === null ? null : <path className={styles.head} d={`M${head} 0V${HEIGHT}`} />}
    </svg>
  );
}

const column = (at_s: number, from_s: number, to_s: number, columns: number) =>
  Number((((at_s - from_s) / Math.max(1e-6, to_s - from_s)) * columns).toFixed(1));

/** The outline of the peaks as an SVG path: the largest of each column, above and below the middle. */
function wavePath(peaks: Float32Array, from_s: number, to_s: number, columns: number): string {
  const heights = Array.from({ length: columns }, (_, i) => {
    const at = (share: number) => (from_s + (share / columns) * (to_s - from_s)) * PEAKS_PER_S;
    let most = 0;
    for (let j = Math.floor(at(i)); j < Math.max(at(i + 1), Math.floor(at(i)) + 1); j++)
      most = Math.max(most, peaks[j] ?? 0);
    return (most * HEIGHT) / 2;
  });
  const middle = HEIGHT / 2;
  const top = heights.map((h, i) => `${i} ${(middle - h).toFixed(1)}`).join('L');
  const bottom = heights.map((h, i) => `${i} ${(middle + h).toFixed(1)}`).reverse();
  return `M${top}L${bottom.join('L')}Z`;
}
