import { useStore } from '../base/store';
import { lengthText, type Unit } from '../base/units';
import { drivesText } from '../make/drive';
import { drawnKind } from '../make/drawnLine';
import { sizeOf, type Pictures } from '../make/pictures';
import { verdictOf } from '../make/verdict';
import type { Making } from '../make/making';
import { VerdictIcon } from '../parts/VerdictIcon';
import { useUnit } from '../session/preferences';
import styles from './Make.module.css';

/** How well the robots show what is made, or why they do not; before that, what to do first. */
export function MakeVerdict({ making }: { making: Making }) {
  const { answer, shown, drives } = useStore(making.made);
  const unit = useUnit();
  const tab = useStore(making.draft, (draft) => draft.tab);
  const told = answer ?? shown;
  const isDrawn = useStore(making.draft, (draft) => drawnKind(draft) !== null);
  const start = isDrawn ? DRAW : START[tab];
  const { tone, text } = told ? verdictOf(told, making.robots) : start;
  return (
    <div
      className={styles.verdict}
      role="status"
      data-testid="verdict"
      data-tone={tone}
      data-old={answer === null || undefined}
    >
      <VerdictIcon tone={tone} size={17} />
      <div>
        {text}
        {told && told.error === null ? <small>{figures(told, unit)}</small> : null}
        {drives ? <small data-testid="drives">{drivesText(drives)}</small> : null}
        {told ? notesOf(told).map((note) => <small key={note}>{note}</small>) : null}
      </div>
    </div>
  );
}

/** What to do first, by tab. */
const START = {
  text: { tone: 'none', text: 'Type words, and the robots show them.' },
  shape: { tone: 'none', text: 'The robots show the shape in a moment.' },
  file: { tone: 'none', text: 'Choose a file, and the robots show it.' },
} as const;

/** What to do first for a shape that is drawn on the floor. */
const DRAW = { tone: 'none', text: 'Draw on the floor, and the robots show the line.' } as const;

/** Up to four different notes, those about the whole first, then those of the pictures, which may be dozens. */
const notesOf = ({ notes, pictures }: Pictures): string[] =>
  [
    ...new Set([...notes, ...pictures.flatMap((p) => p.answer.notes)].map((note) => note.message)),
  ].slice(0, 4);

function figures(made: Pictures, unit: Unit): string {
  const answers = made.pictures.map((picture) => picture.answer);
  const gaps = answers.flatMap(({ closest_m }) => (closest_m === null ? [] : [closest_m]));
  const gap = gaps.length === 0 ? '' : ` · ${lengthText(Math.min(...gaps), unit)} apart`;
  return `${answers[0]?.pixels.length ?? 0} robots · ${lengthText(sizeOf(made) ?? 0, unit)} wide${gap}`;
}
