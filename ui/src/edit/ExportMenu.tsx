import { ActionIcon, Menu } from '@mantine/core';
import { IconDownload } from '@tabler/icons-react';
import { lazy, Suspense, useState } from 'react';
import type { Format } from '../api/formats';
import { listShows, putShow } from '../api/http';
import { writeShow } from '../model/json';
import { ExportItems } from '../parts/ExportItems';
import { downloadShow } from '../session/download';
import { editShow } from '../session/address';
import { attempt, notify } from '../session/notices';
import { openShow } from '../session/openShow';
import { useSession } from '../session/session';
import { freeName } from '../session/upload';
import { useEditing } from './context';
import { LinkDialog } from './LinkDialog';

const FilmDialog = lazy(() => import('./film/FilmDialog'));

/** A menu that saves the show as a file, a film, a link, or a copy in the library. */
export function ExportMenu() {
  const session = useSession();
  const editing = useEditing();
  const { editor } = editing;
  const [isLinking, setLinking] = useState(false);
  const [isFilming, setFilming] = useState(false);
  const show = () => writeShow(editor.state.get().show);
  const save = (format: Format) => attempt(() => downloadShow(show(), editing.name, format));
  const saveAs = async () => {
    const copy = freeName(
      `${editing.name} copy`,
      (await listShows()).map((entry) => entry.name),
    );
    await putShow(copy, JSON.stringify(show()), 'new');
    const isOpen = session.live.opened.get().name === editing.name;
    if (isOpen && !(await openShow(session, copy))) return;
    if (!isOpen) editShow(copy);
    notify('good', `This is now ${copy}.`);
  };
  return (
    <>
      <Menu position="top-end">
        <Menu.Target>
          <ActionIcon
            variant="subtle"
            color="gray"
            size="lg"
            aria-label="Download or copy the show"
          >
            <IconDownload size={18} />
          </ActionIcon>
        </Menu.Target>
        <Menu.Dropdown>
          <ExportItems onExport={save} />
          <Menu.Item onClick={() => setFilming(true)}>Make a film…</Menu.Item>
          <Menu.Item onClick={() => setLinking(true)}>Copy a link to this show</Menu.Item>
          <Menu.Divider />
          <Menu.Item onClick={() => attempt(saveAs)}>Save as a copy</Menu.Item>
        </Menu.Dropdown>
      </Menu>
      {isLinking ? <LinkDialog onClose={() => setLinking(false)} /> : null}
      {isFilming ? (
        <Suspense fallback={null}>
          <FilmDialog onClose={() => setFilming(false)} />
        </Suspense>
      ) : null}
    </>
  );
}
