import { Button, Group, Modal, Stack, Text, TextInput } from '@mantine/core';
import { useEffect, useState } from 'react';
import { messageOf } from '../base/errors';
import { countText } from '../base/numbers';
import { assetsOf } from '../model/assets';
import { writeShow } from '../model/json';
import type { Show } from '../model/show';
import { LINK_CHARS_MAX, packShow } from '../model/showLink';
import { sharedAddress } from '../session/address';
import { notify } from '../session/notices';
import { useEditing } from './context';

/** The show as a document; without a title it gets its name in the library as title. */
const documentOf = (show: Show, name: string) =>
  writeShow(show.name.trim() === '' ? { ...show, name } : show);

/** The link that holds this show, what it leaves out, and a button that copies it. */
export function LinkDialog({ onClose }: { onClose: () => void }) {
  const { editor, name } = useEditing();
  const [show] = useState(() => editor.state.get().show);
  const [link, setLink] = useState<string | null>(null);
  const [failure, setFailure] = useState<string | null>(null);
  useEffect(() => {
    packShow(documentOf(show, name)).then(
      (packed) => setLink(sharedAddress(packed)),
      (error: unknown) => setFailure(messageOf(error)),
    );
  }, [show, name]);
  const files = [...assetsOf(show).values()].map((file) => file.name || 'a file without a name');
  const isTooLong = link !== null && link.length > LINK_CHARS_MAX;
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(link ?? '');
      notify('good', 'Link copied.');
      onClose();
    } catch {
      notify('error', 'The browser does not let this page copy. Choose the link and copy it.');
    }
  };
  return (
    <Modal opened onClose={onClose} title="A link to this show" size="md">
      <Stack gap="sm">
        {isTooLong ? (
          <Text role="alert">
            This show is too large for a link: it would have {link.length.toLocaleString('en')}{' '}
            characters, and more than {LINK_CHARS_MAX.toLocaleString('en')} are cut off on the way.
            Save it as a file instead (same menu, Download).
          </Text>
        ) : (
          <>
            <Text>
              The link holds the show as it is now
              {files.length > 0 ? `, without its ${countText(files.length, 'file')}` : ''}. Any
              LightBots opens it as a new show. Anyone with the link can read the show.
            </Text>
            {files.length > 0 ? (
              <Text size="sm" c="dimmed">
                Left out: {files.join(', ')}. To pass them on, save the show with its files (same
                menu).
              </Text>
            ) : null}
            <TextInput
              label="Link"
              readOnly
              value={link ?? ''}
              error={failure}
              onFocus={(event) => event.currentTarget.select()}
            />
          </>
        )}
        <Group justify="flex-end">
          <Button variant="default" onClick={onClose}>
            Close
          </Button>
          {isTooLong ? null : (
            <Button data-autofocus disabled={link === null} onClick={() => void copy()}>
              Copy the link
            </Button>
          )}
        </Group>
      </Stack>
    </Modal>
  );
}
