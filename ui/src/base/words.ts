/** The text with a capital letter at its begin. */
export const capitalised = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** The text as a sentence: with a capital letter, and a full stop unless it ends with `.`, `!` or `?`. */
export const sentence = (text: string) => capitalised(text) + (/[.!?]$/.test(text) ? '' : '.');
