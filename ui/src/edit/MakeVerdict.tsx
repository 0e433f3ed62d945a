import { IconAlertTriangle, IconCircleCheck, IconInfoCircle } from '@tabler/icons-react';
import type { MakeAnswer } from '../api/types.gen';
import { useStore } from '../base/store';
import { lengthText, type Unit } from '../base/units';
import { drawnKind } from '../make/drawnLine';
import { verdictOf } from '../make/verdict';
import type { Making } from '../make/making';
import { useUnit } from '../session/preferences';
import styles from './Make.module.css';

const ICONS = {
  good: IconCircleCheck,
  care: IconAlertTriangle,
  bad: IconAlertTriangle,
  none: IconInfoCircle,
} as const;

/** How well the robots show what is made, or why they do not. */
export function MakeVerdict({ making }: { making: Making }) {
  const { answer, shown } = useStore(making.made);
  const unit = useUnit();
  const tab = useStore(making.draft, (draft) => draft.tab);
  const told = answer ?? shown;
  const isDrawn = useStore(making.draft, (draft) => drawnKind(draft) !== null);
  const start = isDrawn ? DRAW : START[tab];
  const { tone, text } = told ? verdictOf(told, making.robots) : start;
  const Icon = ICONS[tone];
  return (
    <div
      className={styles.verdict}
      role="status"
      data-testid="verdict"
      data-tone={tone}
      data-old={answer === null || undefined}
    >
      <Icon size={17} aria-hidden />
      <div>
        {text}
        {told && told.error === null ? <small>{figures(told, unit)}</small> : null}
        {told?.notes.map((note) => (
          <small key={note.message}>{note.message}</small>
        ))}
      </div>
    </div>
  );
}

/** What to do first. */
const START = {
  text: { tone: 'none', text: 'Type words, and the robots show them.' },
  shape: { tone: 'none', text: 'The robots show the shape in a moment.' },
  file: { tone: 'none', text: 'Choose a file, and the robots show it.' },
} as const;

const DRAW = { tone: 'none', text: 'Draw on the floor, and the robots show the line.' } as const;

function figures(answer: MakeAnswer, unit: Unit): string {
  const gap = answer.closest_m === null ? '' : ` · ${lengthText(answer.closest_m, unit)} apart`;
  return `${answer.pixels.length} robots · ${lengthText(answer.size_m, unit)} wide${gap}`;
}
