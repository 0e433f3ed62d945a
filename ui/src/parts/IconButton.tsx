import { ActionIcon, Tooltip, type ActionIconProps, type TooltipProps } from '@mantine/core';
import type { ReactNode } from 'react';

interface Props extends ActionIconProps {
  /** The action, shown as a tooltip. */
  label: string;
  /** The button's name for screen readers, if it differs from the label. */
  name?: string;
  position?: TooltipProps['position'];
  onClick: () => void;
  children: ReactNode;
}

/** A button with an icon only; its tooltip names the action. */
export function IconButton({ label, name = label, position, ...more }: Props) {
  return (
    <Tooltip label={label} position={position}>
      <ActionIcon variant="subtle" color="gray" aria-label={name} {...more} />
    </Tooltip>
  );
}
