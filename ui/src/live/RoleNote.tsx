import { useWhyNot } from '../parts/Gate';

/** Says why the buttons beside it do nothing for this person, and what the person can do; nothing for an operator. */
export function RoleNote() {
  const reason = useWhyNot('operator', 'press Play');
  if (reason === null) return null;
  return (
    <span className="quiet" role="note">
      {reason} You can press Stop all.
    </span>
  );
}
