import { useStore } from '../base/store';
import { useSession } from '../session/session';
import page from '../parts/page.module.css';
import styles from './DriveProgress.module.css';

/** Progress of the drive to the frame. A component of its own, because it changes often. */
export function DriveProgress() {
  const { live } = useSession();
  const done = useStore(live.playback, (p) => p.progress);
  return (
    <div
      className={`${page.progress} ${styles.drive}`}
      role="progressbar"
      aria-label="Drive to the frame"
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuenow={Math.round(done * 100)}
    >
      <i style={{ transform: `scaleX(${done})` }} />
    </div>
  );
}
