import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { getShow, putShow, Refused } from '../api/http';
import { attempt } from './libraryActs';
import { useSession, type Session } from './session';
import { goTo } from './useHash';

/** Says that an earlier page left changes the server never got, and where they are. */
export function DraftBanner() {
  const session = useSession();
  const name = useStore(session.orphans)[0];
  const linked = useStore(session.live.link) === 'open';
  if (name === undefined || !linked) return null;
  const putBack = () =>
    attempt(async () => {
      await bringBack(session, name);
      if (session.live.opened.get().name === name || (await session.ask({ do: 'open', name })).ok)
        goTo('edit');
    });
  const drop = () => {
    session.drafts.drop(name);
    session.orphans.update((names) => names.filter((n) => n !== name));
  };
  return (
    <div className="banner" role="status">
      Changes of {name} never reached the server. This browser has kept them.{' '}
      <Button size="compact-xs" variant="default" onClick={() => void putBack()}>
        Put them back
      </Button>{' '}
      <Button size="compact-xs" variant="subtle" color="gray" onClick={drop}>
        Drop them
      </Button>
    </div>
  );
}

/** Makes sure the library has a show of that name; one that is gone begins again as its draft. */
async function bringBack({ drafts }: Session, name: string) {
  try {
    await getShow(name);
  } catch (error) {
    const draft = drafts.read(name);
    if (!(error instanceof Refused) || error.status !== 404 || !draft) throw error;
    await putShow(name, JSON.stringify(draft.document), 'new');
  }
}
