import { Button, Modal, Stack, Text } from '@mantine/core';
import { getShow, listShows, putShow, Refused } from '../api/http';
import { useStore } from '../base/store';
import { readShow, writeShow } from '../model/json';
import { editShow } from '../session/address';
import { attempt } from '../session/notices';
import { freeName } from '../session/upload';
import { useEditing } from './context';

/** Shown when another screen saved this show since this screen read it: the user chooses which one to keep, or both. */
export function ConflictDialog() {
  const editing = useEditing();
  const { editor, saver } = editing;
  const conflict = useStore(saver.state, (s) => s.name === 'conflict');
  const takeTheirs = async () => {
    const { document, etag } = await getShow(editing.name);
    editor.adopt(readShow(document));
    saver.settle(etag);
  };
  const keepMine = async () => {
    try {
      saver.rebase((await getShow(editing.name)).etag);
    } catch (error) {
      if (!(error instanceof Refused) || error.status !== 404) throw error;
      // The other screen deleted the show: this screen's version becomes a new show of that name.
      saver.rebase(null);
    }
  };
  const keepBoth = async () => {
    const copy = freeName(
      `${editing.name} (copy)`,
      (await listShows()).map((entry) => entry.name),
    );
    await putShow(copy, JSON.stringify(writeShow(editor.state.get().show)), 'new');
    saver.settle(saver.etag());
    editShow(copy);
  };
  return (
    <Modal
      opened={conflict}
      onClose={() => undefined}
      withCloseButton={false}
      closeOnEscape={false}
      title="This show changed on another screen"
    >
      <Text mb="md">
        Your last changes are only on this screen. Nothing is overwritten until you choose.
      </Text>
      <Stack gap="xs">
        <Button onClick={() => attempt(keepBoth)}>Keep both: save mine as a copy</Button>
        <Button variant="default" onClick={() => attempt(takeTheirs)}>
          Use theirs
        </Button>
        <Button variant="default" onClick={() => attempt(keepMine)}>
          Use mine
        </Button>
      </Stack>
    </Modal>
  );
}
