/** What an error says to people; of another thrown value, its text. */
export const messageOf = (error: unknown): string =>
  error instanceof Error ? error.message : String(error);
