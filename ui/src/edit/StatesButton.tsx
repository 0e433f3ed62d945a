import { IconHistory } from '@tabler/icons-react';
import { useState } from 'react';
import { IconButton } from '../parts/IconButton';
import { StatesDialog } from '../parts/StatesDialog';
import { useEditing } from './context';

/** Opens the saved states of the show that is edited. */
export function StatesButton() {
  const { name } = useEditing();
  const [opened, setOpened] = useState(false);
  return (
    <>
      <IconButton label="Earlier saves" size="lg" onClick={() => setOpened(true)}>
        <IconHistory size={18} />
      </IconButton>
      {opened ? <StatesDialog name={name} onClose={() => setOpened(false)} /> : null}
    </>
  );
}
