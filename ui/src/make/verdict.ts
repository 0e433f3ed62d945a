import type { MakeAnswer } from '../api/types.gen';

/** A sentence for people about an answer. */
export interface Verdict {
  tone: 'good' | 'care' | 'bad' | 'none';
  text: string;
}

/** How well robots show what was made, or why there is nothing. */
export function verdictOf(answer: MakeAnswer, robots: number): Verdict {
  if (answer.error) return { tone: 'bad', text: sentence(answer.error.message) };
  if (!answer.readability) return { tone: 'none', text: `Room for all ${robots} robots` };
  if (answer.readability.readable) return { tone: 'good', text: 'Readable' };
  const { enough } = answer;
  if (enough === null) return { tone: 'care', text: 'Hard to read' };
  return {
    tone: 'care',
    text:
      enough > robots
        ? `Hard to read: ${enough} robots would do`
        : 'Hard to read: another style or size may help',
  };
}

const sentence = (text: string) => {
  const first = text.charAt(0).toUpperCase() + text.slice(1);
  return /[.!?]$/.test(first) ? first : `${first}.`;
};
