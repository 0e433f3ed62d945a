import { createStore, type Readable } from '../base/store';
import type { LinkState } from '../api/socket';
import { isRole, type Role } from './roles';

const ADDRESS = '/api/session';

/** The person of this page. */
export interface SignedIn {
  name: string;
  role: string;
}

/** The person of this page; null where sign-in is not asked for, or the server does not answer. */
export async function signedIn(): Promise<SignedIn | null> {
  try {
    const answer = await fetch(ADDRESS);
    if (!answer.ok) return null;
    const { name, role } = (await answer.json()) as { name: string | null; role: string };
    return name === null ? null : { name, role };
  } catch {
    return null;
  }
}

/** Shows the sign-in page if the session of this page has ended. */
export async function leaveIfSignedOut() {
  try {
    if ((await fetch(ADDRESS)).status === 401) location.reload();
  } catch {
    // The server does not answer: the page connects again by itself.
  }
}

/** Ends the session. The sign-in page comes in any case, so that a failed sign-out is seen. */
export async function signOut() {
  try {
    await fetch(ADDRESS, { method: 'DELETE' });
  } finally {
    location.reload();
  }
}

/** The role of this person, asked for with each connection. Until it is known, and without sign-in: `operator`. */
export function followRole(link: Readable<LinkState>): Readable<Role> {
  const role = createStore<Role>('operator');
  link.subscribe(() => {
    if (link.get() !== 'open') return;
    void signedIn().then((person) => {
      if (person !== null && isRole(person.role)) role.set(person.role);
    });
  });
  return role;
}
