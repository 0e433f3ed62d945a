import { NativeSelect } from '@mantine/core';
import { isRole, ROLES, type Role } from '../session/roles';

interface Props {
  label: string;
  /** Whether the label is shown; if not, only screen readers say it. */
  isShown?: boolean;
  role: Role;
  onRole: (role: Role) => void;
}

/** Chooses a role. */
export function RoleSelect({ label, isShown, role, onRole }: Props) {
  return (
    <NativeSelect
      label={isShown ? label : undefined}
      aria-label={isShown ? undefined : label}
      data={ROLES.map((value) => ({ value, label: value }))}
      value={role}
      onChange={({ currentTarget: { value } }) => {
        if (isRole(value)) onRole(value);
      }}
    />
  );
}
