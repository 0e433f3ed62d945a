import { Button } from '@mantine/core';
import { useStore } from '../base/store';
import { getShow, putShow, Refused } from '../api/http';
import type { LeftDraft } from '../model/drafts';
import { attempt } from '../session/libraryActs';
import { editShow } from '../session/address';
import { useSession } from '../session/session';

/** Says that a closed page left unsaved changes, the newest such draft, and offers to restore or drop them. */
export function DraftBanner() {
  const session = useSession();
  const draft = useStore(session.orphans)[0];
  const linked = useStore(session.live.link) === 'open';
  if (!draft || !linked) return null;
  const { name } = draft;
  const putBack = () =>
    attempt(async () => {
      await bringBack(draft);
      session.restoring.set(draft);
      editShow(name);
    });
  const drop = () => {
    session.drafts.drop(draft.id);
    session.orphans.set(session.drafts.left());
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

/** Makes sure that the library has the draft's show; if it was deleted, the draft becomes the show. */
async function bringBack({ name, document }: LeftDraft) {
  try {
    await getShow(name);
  } catch (error) {
    if (!(error instanceof Refused) || error.status !== 404) throw error;
    await putShow(name, JSON.stringify(document), 'new');
  }
}
