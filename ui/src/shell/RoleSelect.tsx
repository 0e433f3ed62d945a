import { NativeSelect } from '@mantine/core';
import { ROLES } from '../session/roles';

interface Props {
  label: string;
  /** Whether the label is seen, or only told by screen readers. */
  isShown?: boolean;
  role: string;
  onRole: (role: string) => void;
}

/** Chooses a role. */
export function RoleSelect({ label, isShown, role, onRole }: Props) {
  return (
    <NativeSelect
      label={isShown ? label : undefined}
      aria-label={isShown ? undefined : label}
      data={ROLES.map((value) => ({ value, label: value }))}
      value={role}
      onChange={(event) => onRole(event.currentTarget.value)}
    />
  );
}
