import { Button, Stack } from '@mantine/core';
import type { Issue } from '../api/types.gen';
import styles from './IssueList.module.css';

/** Most issues in the list; the number of further ones is written below it. */
const SHOWN_MAX = 30;

const WORDS = { note: 'Note', warning: 'Warning', error: 'Error' } as const;

/** The issues of a show; one about a frame has a button that shows the frame. */
export function IssueList(props: { issues: readonly Issue[]; onFrame: (index: number) => void }) {
  const { issues, onFrame } = props;
  if (issues.length === 0) return null;
  return (
    <Stack gap={6} role="list" aria-label="Issues">
      {issues.slice(0, SHOWN_MAX).map((issue, i) => (
        <div key={i} className={styles.issue} data-severity={issue.severity} role="listitem">
          <b>{WORDS[issue.severity]}:</b> {issue.message}{' '}
          {issue.frame === null ? null : (
            <Button
              variant="subtle"
              color="gray"
              size="compact-xs"
              onClick={() => onFrame(issue.frame ?? 0)}
            >
              Show frame {issue.frame + 1}
            </Button>
          )}
        </div>
      ))}
      {issues.length > SHOWN_MAX ? (
        <p className="quiet">and {issues.length - SHOWN_MAX} more</p>
      ) : null}
    </Stack>
  );
}
