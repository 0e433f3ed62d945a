import { ActionIcon, Indicator, Tooltip } from '@mantine/core';
import { IconChecklist } from '@tabler/icons-react';
import { useStore } from '../base/store';
import { useSession } from '../session/session';
import { isReady } from '../session/checklist';
import { checkNow } from '../session/start';

/** A button that opens the checklist; a dot on it shows that not all checks pass. */
export function ChecklistButton() {
  const session = useSession();
  const { live } = session;
  useStore(live.fleet);
  useStore(live.plan);
  useStore(live.opened);
  const missing = !isReady(checkNow(session));
  const label = missing ? 'Checklist: something is missing (C)' : 'Checklist: all is ready (C)';
  return (
    <Tooltip label={label}>
      <Indicator disabled={!missing} size={9} offset={5} color="care">
        <ActionIcon
          variant="subtle"
          color="gray"
          size="lg"
          aria-label={label}
          onClick={() => session.checking.set(true)}
        >
          <IconChecklist size={19} />
        </ActionIcon>
      </Indicator>
    </Tooltip>
  );
}
