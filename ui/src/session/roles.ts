/** The roles, the least first: each may do what those before it may. */
export const ROLES = ['viewer', 'editor', 'operator'] as const;

export type Role = (typeof ROLES)[number];

export const isRole = (text: string): text is Role => ROLES.some((role) => role === text);

const ARTICLES = { viewer: 'A', editor: 'An', operator: 'An' } as const;

/** Why a role is not enough, and which one is; null: it is enough. `act`: what is done, such as "press Play". */
export function whyNot(role: Role, needed: Role, act: string): string | null {
  if (ROLES.indexOf(role) >= ROLES.indexOf(needed)) return null;
  return `Your role is ${role}. ${ARTICLES[needed]} ${needed} can ${act}.`;
}
