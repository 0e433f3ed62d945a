import { Button } from '@mantine/core';
import { useState } from 'react';
import { useStore } from '../base/store';
import { useWhyNot } from '../parts/Gate';
import { useSession } from '../session/session';
import { PreflightDialog } from './PreflightDialog';

/** A button that opens the preflight; coloured if the last one found robots with faults. */
export function PreflightButton() {
  const { live } = useSession();
  const [opened, setOpened] = useState(false);
  const named = useStore(live.playback, (p) => p.preflight?.named ?? 0);
  const reason = useWhyNot('operator', 'test robots');
  return (
    <>
      <Button
        size="compact-xs"
        variant={named > 0 ? 'light' : 'subtle'}
        color={named > 0 ? 'care' : 'gray'}
        disabled={reason !== null}
        title={reason ?? undefined}
        onClick={() => setOpened(true)}
      >
        Preflight…
      </Button>
      <PreflightDialog opened={opened} onClose={() => setOpened(false)} />
    </>
  );
}
