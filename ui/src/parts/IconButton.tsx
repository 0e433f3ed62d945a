import { ActionIcon, Tooltip, type ActionIconProps, type TooltipProps } from '@mantine/core';
import type { ReactNode } from 'react';

interface Props extends ActionIconProps {
  /** What it does, shown beside the pointer. */
  label: string;
  /** Its name for those who hear the page, where that is another. */
  name?: string;
  position?: TooltipProps['position'];
  onClick: () => void;
  children: ReactNode;
}

/** A button that is only a picture: it says in words what it does. */
export function IconButton({ label, name = label, position, ...more }: Props) {
  return (
    <Tooltip label={label} position={position}>
      <ActionIcon variant="subtle" color="gray" aria-label={name} {...more} />
    </Tooltip>
  );
}
