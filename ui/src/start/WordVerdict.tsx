import { IconAlertTriangle, IconCircleCheck, IconInfoCircle } from '@tabler/icons-react';
import type { MadeTemplateFrame } from '../make/templateShow';
import { verdictOfAnswer } from '../make/verdict';
import styles from './Start.module.css';

const ICONS = {
  good: IconCircleCheck,
  care: IconAlertTriangle,
  bad: IconAlertTriangle,
  none: IconInfoCircle,
} as const;

/** How well the robots show the words. */
export function WordVerdict({ made, robots }: { made: MadeTemplateFrame | null; robots: number }) {
  const { tone, text } = made
    ? verdictOfAnswer(made.answer, robots)
    : { tone: 'none' as const, text: 'The floor shows what your robots make of it.' };
  const Icon = ICONS[tone];
  return (
    <p className={styles.verdict} role="status" data-tone={tone} data-testid="word-verdict">
      <Icon size={18} aria-hidden />
      <span>
        {text}
        {tone === 'good' ? <span className="quiet"> with {robots} robots</span> : null}
      </span>
    </p>
  );
}
