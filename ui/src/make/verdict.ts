import type { MakeAnswer } from '../api/types.gen';
import { countText } from '../base/numbers';
import { sentence } from '../base/words';
import type { Pictures } from './pictures';

/** A short text for people about what was made, and how good it is. */
export interface Verdict {
  tone: 'good' | 'care' | 'bad' | 'none';
  text: string;
}

/** How well robots show the pictures, or why there are none. */
export function verdictOf({ pictures, error }: Pictures, robots: number): Verdict {
  if (error) return { tone: 'bad', text: sentence(error.message) };
  const [first] = pictures;
  return pictures.length === 1 && first
    ? verdictOfAnswer(first.answer, robots)
    : verdictOfSeries(pictures.map((picture) => picture.answer));
}

/** How well `robots` robots show one picture, or why there is none. */
export function verdictOfAnswer(answer: MakeAnswer, robots: number): Verdict {
  const { readability, enough, error } = answer;
  if (error) return { tone: 'bad', text: sentence(error.message) };
  if (!readability) return { tone: 'none', text: `Room for all ${robots} robots` };
  if (readability.readable) return { tone: 'good', text: 'Readable' };
  if (enough === null) return { tone: 'care', text: 'Hard to read' };
  return {
    tone: 'care',
    text:
      enough > robots
        ? `Hard to read: ${enough} robots would do`
        : 'Hard to read: another style or size may help',
  };
}

function verdictOfSeries(answers: readonly MakeAnswer[]): Verdict {
  const hard = answers.filter((answer) => answer.readability?.readable === false).length;
  return hard === 0
    ? { tone: 'good', text: `${countText(answers.length, 'frame')}, all readable` }
    : { tone: 'care', text: `${countText(answers.length, 'frame')}, ${hard} hard to read` };
}
