import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { useSession } from './session';
import { goTo } from './useHash';

/** Says that an earlier page left changes the server never got, and where they are. */
export function DraftBanner() {
  const session = useSession();
  const name = useStore(session.orphans)[0];
  const linked = useStore(session.live.link) === 'open';
  if (name === undefined || !linked) return null;
  const putBack = async () => {
    if (session.live.opened.get().name !== name && !(await session.ask({ do: 'open', name })).ok)
      return;
    goTo('edit');
  };
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
