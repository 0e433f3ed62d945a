import type { MadeTemplateFrame } from '../make/templateShow';
import { verdictOfAnswer } from '../make/verdict';
import { VerdictIcon } from '../parts/VerdictIcon';
import styles from './Start.module.css';

/** How well the robots show the words, or a hint before any are made. */
export function WordVerdict({ made, robots }: { made: MadeTemplateFrame | null; robots: number }) {
  const { tone, text } = made
    ? verdictOfAnswer(made.answer, robots)
    : { tone: 'none' as const, text: 'The floor shows what your robots make of it.' };
  return (
    <p className={styles.verdict} role="status" data-tone={tone} data-testid="word-verdict">
      <VerdictIcon tone={tone} size={18} />
      <span>
        {text}
        {tone === 'good' ? <span className="quiet"> with {robots} robots</span> : null}
      </span>
    </p>
  );
}
