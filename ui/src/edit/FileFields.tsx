import { Button, FileButton, Text } from '@mantine/core';
import { countText } from '../base/numbers';
import { useStore } from '../base/store';
import { isSeen } from '../make/draft';
import type { Making } from '../make/making';
import { useSession } from '../session/session';
import { useEditing } from './context';
import { PictureField } from './PictureField';
import { WayFields } from './WayFields';
import { takeFiles } from './taking';
import styles from './Make.module.css';

const ACCEPTED =
  '.svg,.png,.jpg,.jpeg,.webp,.gif,.csv,image/svg+xml,image/png,image/jpeg,image/webp,image/gif,text/csv';

/** Files to make frames from. They can also be dropped anywhere on the page. */
export function FileFields({ making }: { making: Making }) {
  const session = useSession();
  const editing = useEditing();
  const files = useStore(making.draft, (draft) => draft.files);
  const [first] = files;
  return (
    <>
      <div className={styles.drop}>
        <Text size="sm" fw={first ? 600 : undefined}>
          {files.length > 1
            ? countText(files.length, 'file')
            : (first?.name ?? 'Drop files anywhere')}
        </Text>
        <FileButton
          multiple
          accept={ACCEPTED}
          onChange={(chosen) => {
            if (chosen.length > 0) void takeFiles(session, editing, chosen);
          }}
          inputProps={{ 'aria-label': 'Files' }}
        >
          {(props) => (
            <Button size="xs" variant="default" {...props}>
              {first ? 'Choose others…' : 'Choose files…'}
            </Button>
          )}
        </FileButton>
        <Text size="xs" c="dimmed">
          An SVG drawing, a picture, an animation (GIF, WebP), or a list of places and colours
          (CSV). Several files make a frame each.
        </Text>
      </div>
      {files.some(isSeen) ? <WayFields making={making} /> : null}
      <PictureField making={making} />
    </>
  );
}
