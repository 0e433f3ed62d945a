import styles from './GoMark.module.css';

/** Marks a frame after which the show waits for GO, or repeats frames until GO. */
export const GoMark = ({ go }: { go: 'waits' | 'repeats' }) =>
  go === 'waits' ? (
    <em className={styles.go} title="Waits for GO">
      GO
    </em>
  ) : (
    <em className={styles.go} title="Repeats until GO">
      <span aria-hidden="true">↻ </span>GO
    </em>
  );
