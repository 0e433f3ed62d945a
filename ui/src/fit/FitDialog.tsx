import { messageOf } from '../base/errors';
import { Button, Group, Loader, Modal, Text } from '@mantine/core';
import { useEffect, useState } from 'react';
import { countText } from '../base/numbers';
import { startWorker } from '../make/browserWorker';
import { createMaker } from '../make/maker';
import { fleetSize } from '../model/commands';
import type { Show } from '../model/show';
import { changeShow } from '../session/changeShow';
import { showNow } from '../session/fitness';
import { notifyWithUndo } from '../session/notices';
import { useSession } from '../session/session';
import { Thumbnail } from '../stage/Thumbnail';
import { fitShow, withPixels, type Fitted } from './fitting';
import styles from './Fit.module.css';

/** Most frames that are shown before and after; all are fitted. */
const SHOWN_MAX = 60;

/** Shows the frames of the show before and after it is fitted to `robots` robots, and fits it if the user agrees. */
export default function FitDialog({ robots }: { robots: number }) {
  const session = useSession();
  const [show] = useState(() => showNow(session));
  const found = useFitted(show, robots);
  const close = () => session.fitting.set(null);
  if (!show) return null;
  const title = `Fit to ${countText(robots, 'robot')}`;
  const apply = async ({ show: fitted }: Fitted) => {
    close();
    await changeShow(session, title, (now) => withPixels(now, fitted));
    notifyWithUndo(`The show has ${countText(robots, 'pixel')} in every frame.`, () => {
      void changeShow(session, `Undo: ${title}`, (now) => withPixels(now, show));
    });
  };
  return (
    <Modal opened onClose={close} title={title} size="lg">
      <Text size="sm">
        The show has {countText(fleetSize(show), 'pixel')}, and {countText(robots, 'robot')}{' '}
        {robots === 1 ? 'is' : 'are'} here. Words, shapes and files are made anew for them; other
        pixels keep their places as far as possible.
      </Text>
      {typeof found === 'string' ? (
        <Text role="alert" my="md">
          {found}
        </Text>
      ) : (
        <Frames show={show} fitted={found} />
      )}
      <Group justify="flex-end" mt="md">
        <Button variant="default" onClick={close}>
          Not now
        </Button>
        <Button
          data-autofocus
          disabled={found === null || typeof found === 'string'}
          onClick={() => {
            if (found !== null && typeof found !== 'string') void apply(found);
          }}
        >
          {title}
        </Button>
      </Group>
    </Modal>
  );
}

/** The fitted show, why there is none, or null while it is made. */
function useFitted(show: Show | null, robots: number): Fitted | string | null {
  const [found, setFound] = useState<Fitted | string | null>(null);
  useEffect(() => {
    if (!show) return;
    const maker = createMaker(startWorker);
    let isWanted = true;
    fitShow(maker, show, robots).then(
      (fitted) => {
        if (isWanted) setFound(fitted);
      },
      (error: unknown) => {
        if (isWanted) setFound(messageOf(error));
      },
    );
    return () => {
      isWanted = false;
      maker.end();
    };
  }, [show, robots]);
  return found;
}

function Frames({ show, fitted }: { show: Show; fitted: Fitted | null }) {
  const frames = show.frames.slice(0, SHOWN_MAX);
  const more = show.frames.length - frames.length;
  return (
    <div aria-busy={fitted === null}>
      <ol className={styles.frames} aria-label="Frames before and after">
        {frames.map((frame, i) => {
          const after = fitted?.show.frames[i];
          return (
            <li key={frame.key}>
              <b>{frame.name || `Frame ${i + 1}`}</b>
              <span className={styles.pair}>
                <Thumbnail frame={frame} stage={show.stage} />
                <span aria-hidden>→</span>
                {after ? (
                  <Thumbnail frame={after} stage={show.stage} />
                ) : (
                  <Loader size="sm" aria-label="Fitting" />
                )}
              </span>
              <span className="quiet">
                {frame.pixels.length} → {after?.pixels.length ?? '…'}
              </span>
            </li>
          );
        })}
      </ol>
      {more > 0 ? <Text size="xs">And {countText(more, 'more frame')}.</Text> : null}
      {[...new Set(fitted?.notes.map((note) => note.message))].slice(0, 6).map((note) => (
        <Text size="xs" c="dimmed" key={note}>
          {note}
        </Text>
      ))}
    </div>
  );
}
