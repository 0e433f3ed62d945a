import { Button } from '@mantine/core';
import { useState } from 'react';
import { PlacesDialog } from './PlacesDialog';

/** A button that opens the comparison of robots' places with the starting places. */
export function PlacesButton() {
  const [opened, setOpened] = useState(false);
  return (
    <>
      <Button size="compact-xs" variant="subtle" color="gray" onClick={() => setOpened(true)}>
        Places…
      </Button>
      <PlacesDialog opened={opened} onClose={() => setOpened(false)} />
    </>
  );
}
