import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { editShow, type View } from '../session/address';
import { openShow } from '../session/openShow';
import { useSession } from '../session/session';

/** In the editor, says that another show is open on the server than the one this screen edits. */
export function NotOpenBanner({ view }: { view: View }) {
  const session = useSession();
  const open = useStore(session.live.opened, (o) => o.name);
  const { name, failure } = useStore(session.shown);
  if (view !== 'edit' || name === null || open === null || name === open || failure !== null)
    return null;
  return (
    <div className="banner" role="status">
      You edit {name}, and {open} is open for the robots. Changes are saved; {name} is planned once
      it is open.{' '}
      <Button
        size="compact-xs"
        variant="default"
        onClick={() => void openShow(session, name)}
        data-testid="open-edited"
      >
        Open {name}
      </Button>{' '}
      <Button size="compact-xs" variant="subtle" color="gray" onClick={() => editShow(open)}>
        Edit {open}
      </Button>
    </div>
  );
}
