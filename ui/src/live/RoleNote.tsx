import { useWhyNot } from '../parts/Gate';

/** Says in the bar of Play why its buttons do nothing for this person, and what the person can do. */
export function RoleNote() {
  const reason = useWhyNot('operator', 'press Play');
  if (reason === null) return null;
  return (
    <span className="quiet" role="note">
      {reason} You can press Stop all.
    </span>
  );
}
