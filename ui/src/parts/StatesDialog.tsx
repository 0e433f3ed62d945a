import { Button, Modal, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { getState, listStates } from '../api/http';
import type { ShowState } from '../api/types.gen';
import { countText } from '../base/numbers';
import { readShow } from '../model/json';
import type { Show } from '../model/show';
import { attempt } from '../session/libraryActs';
import { useSession } from '../session/session';
import { restoreState, savedText } from '../session/states';
import { Thumbnail } from '../stage/Thumbnail';
import { ShowThumbnail } from './ShowThumbnail';
import rows from './rows.module.css';
import styles from './StatesDialog.module.css';

interface Props {
  /** Name of the show in the library. */
  name: string;
  onRestored?: () => void;
  onClose: () => void;
}

/** A dialog with the saved states of a show, each of which can be looked at and restored. */
export function StatesDialog({ name, onRestored, onClose }: Props) {
  const session = useSession();
  const [states, setStates] = useState<readonly ShowState[]>();
  const [chosen, setChosen] = useState<number | null>();
  useEffect(() => {
    void attempt(() => listStates(name).then(setStates));
  }, [name]);
  const restore = async (number: number, when: string) => {
    if (!(await attempt(() => restoreState(session, name, number, when)))) return;
    onRestored?.();
    onClose();
  };
  return (
    <Modal opened onClose={onClose} title={`Earlier saves of ${name}`} size="lg">
      <ul className={rows.list} aria-label="Saved states">
        {states?.map((state) => (
          <State
            key={state.number}
            name={name}
            state={state}
            open={state.number === chosen}
            onLook={() => setChosen(state.number === chosen ? undefined : state.number)}
            onRestore={restore}
          />
        ))}
      </ul>
      <Text c="dimmed" size="xs" mt="md">
        {states?.length === 1
          ? 'Each change is saved by itself; the states before it are listed here.'
          : 'The last 20 saves, and the last of each day before. Restoring is a save too: nothing is lost.'}
      </Text>
    </Modal>
  );
}

interface StateProps {
  name: string;
  state: ShowState;
  /** Whether the frames of the state are shown. */
  open: boolean;
  onLook: () => void;
  onRestore: (number: number, when: string) => Promise<void>;
}

function State({ name, state, open, onLook, onRestore }: StateProps) {
  const { number } = state;
  const when = savedText(state.saved_ms);
  return (
    <li>
      <div className={rows.row}>
        <button type="button" className={rows.entry} aria-expanded={open} onClick={onLook}>
          <ShowThumbnail
            version={`${name} ${state.etag}`}
            load={() => getState(name, state.number)}
          />
          <span className={styles.when}>
            {number === null ? 'Now' : when}
            <span className="quiet">
              {countText(state.frames, 'frame')} · {countText(state.pixels, 'robot')}
            </span>
          </span>
        </button>
        {number === null ? null : (
          <Button
            size="xs"
            variant="default"
            aria-label={`Restore the save of ${when}`}
            onClick={() => void onRestore(number, when)}
          >
            Restore
          </Button>
        )}
      </div>
      {open ? <Frames name={name} number={number} /> : null}
    </li>
  );
}

/** All frames of a state. */
function Frames({ name, number }: { name: string; number: number | null }) {
  const [show, setShow] = useState<Show>();
  useEffect(() => {
    void attempt(() => getState(name, number).then((document) => setShow(readShow(document))));
  }, [name, number]);
  if (!show) return null;
  return (
    <ol className={styles.frames} aria-label="Frames of the state">
      {show.frames.map((frame, index) => (
        <li key={index}>
          <Thumbnail frame={frame} stage={show.stage} />
          {frame.name}
        </li>
      ))}
    </ol>
  );
}
