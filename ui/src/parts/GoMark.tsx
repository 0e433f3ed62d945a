import styles from './GoMark.module.css';

/** Marks a frame after which the show waits for GO. */
export const GoMark = () => (
  <em className={styles.go} title="Waits for GO">
    GO
  </em>
);
