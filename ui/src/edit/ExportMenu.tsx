import { ActionIcon, Menu } from '@mantine/core';
import { IconDownload } from '@tabler/icons-react';
import { convertShow, listShows, putShow } from '../api/http';
import { writeShow } from '../model/json';
import { download } from '../session/download';
import { tell } from '../session/notices';
import { useSession } from '../session/session';
import { freeName } from '../session/upload';
import { useEditing } from './context';

/** The show as a file: ours, or the original's. */
export function ExportMenu() {
  const session = useSession();
  const editing = useEditing();
  const { editor } = editing;
  const text = () => JSON.stringify(writeShow(editor.state.get().show), null, 1);
  const run = (act: () => Promise<void>) =>
    void act().catch((e: unknown) => tell('error', e instanceof Error ? e.message : String(e)));
  const original = async () =>
    download(await convertShow(text(), 'original'), `${editing.name}.json`);
  const saveAs = async () => {
    const copy = freeName(
      `${editing.name} copy`,
      (await listShows()).map((entry) => entry.name),
    );
    await putShow(copy, text(), 'new');
    if ((await session.ask({ do: 'open', name: copy })).ok) tell('good', `This is now ${copy}.`);
  };
  return (
    <Menu position="top-end">
      <Menu.Target>
        <ActionIcon variant="subtle" color="gray" size="lg" aria-label="Download or copy the show">
          <IconDownload size={18} />
        </ActionIcon>
      </Menu.Target>
      <Menu.Dropdown>
        <Menu.Item onClick={() => download(text(), `${editing.name}.lightbots.json`)}>
          Download
        </Menu.Item>
        <Menu.Item onClick={() => run(original)}>Download in the original’s format</Menu.Item>
        <Menu.Divider />
        <Menu.Item onClick={() => run(saveAs)}>Save as a copy</Menu.Item>
      </Menu.Dropdown>
    </Menu>
  );
}
