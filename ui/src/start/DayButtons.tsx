import type { PlaylistDay } from '../api/types.gen';
import { DAYS } from '../session/playlist';
import styles from './Playlist.module.css';

interface Props {
  /** The chosen days; none: every day. */
  days: readonly PlaylistDay[];
  onDays: (days: readonly PlaylistDay[]) => void;
}

/** Chooses days of the week. */
export function DayButtons({ days, onDays }: Props) {
  const toggle = (day: PlaylistDay) =>
    onDays(days.includes(day) ? days.filter((other) => other !== day) : [...days, day]);
  return (
    <div role="group" aria-label="Days">
      <div className={styles.days}>
        {DAYS.map(({ value, label, title }) => (
          <button
            key={value}
            type="button"
            aria-pressed={days.includes(value)}
            onClick={() => toggle(value)}
          >
            <span aria-hidden>{label}</span>
            <span className="hidden-text">{title}</span>
          </button>
        ))}
      </div>
      <span className={`quiet ${styles.hint}`}>
        {days.length === 0 || days.length === DAYS.length ? 'Every day' : 'On the marked days'}
      </span>
    </div>
  );
}
