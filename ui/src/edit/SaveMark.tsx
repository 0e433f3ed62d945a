import { Tooltip } from '@mantine/core';
import { useStore } from '../base/store';
import { useEditing } from './context';
import styles from '../parts/Pill.module.css';

const WORDS = {
  saved: 'Saved',
  waiting: 'Saving…',
  saving: 'Saving…',
  conflict: 'Not saved: conflict',
  failed: 'Not saved yet',
} as const;

/** Says whether the library has the changes of this screen. */
export function SaveMark() {
  const { saver, keeper } = useEditing();
  const state = useStore(saver.state);
  const tone =
    state.name === 'saved'
      ? 'good'
      : state.name === 'failed' || state.name === 'conflict'
        ? 'bad'
        : 'quiet';
  const hint =
    state.name === 'failed'
      ? `${state.reason} Trying again by itself; ${
          keeper.isEndangered()
            ? 'leave this page open, the show is too large to be kept in the browser.'
            : 'until then this browser keeps it.'
        }`
      : 'Every change is saved by itself.';
  return (
    <Tooltip label={hint} multiline maw={300}>
      <span
        className={styles.pill}
        role="status"
        data-tone={tone}
        data-testid="save"
        data-save={state.name}
      >
        <i aria-hidden />
        {WORDS[state.name]}
      </span>
    </Tooltip>
  );
}
