import { useRef, type KeyboardEvent, type PointerEvent } from 'react';
import { useStore } from '../../base/store';
import { xOf } from '../../model/timelineAxis';
import { markersOf, sectionsOf, type SectionPart } from '../../model/timelineMarks';
import { useEditing } from '../context';
import { NameField } from '../NameField';
import { edgeKey, takeKey } from './edgeKeys';
import { followPointer } from './followPointer';
import { dragMark, markText, removeMark, renameMark, sayMark, stepMark } from './markActs';
import { useTimelineView, type ChosenMark, type TrackProps } from './timelineView';
import styles from './Timeline.module.css';

/** The markers of the timeline as flags, or its sections as bars. */
export function MarksLane({ kind, show, axis }: TrackProps & { kind: ChosenMark['kind'] }) {
  const editing = useEditing();
  const view = useTimelineView();
  const mark = useStore(view.mark);
  const naming = useStore(view.naming);
  const list = useRef<HTMLDivElement>(null);
  const items =
    kind === 'marker'
      ? markersOf(show).map(({ name, at_s }) => ({ name, from_s: at_s, to_s: at_s }))
      : sectionsOf(show);
  const chosen = mark?.kind === kind && mark.index < items.length ? mark : null;
  const order = items.map((_, i) => i).sort((a, b) => fromOf(a) - fromOf(b));
  function fromOf(index: number) {
    return items[index]?.from_s ?? 0;
  }
  const choose = (index: number | undefined) => {
    if (index === undefined) return;
    view.mark.set({ kind, index });
    sayMark(editing, view, { kind, index });
  };
  const step = (by: 1 | -1) => {
    const place = chosen ? order.indexOf(chosen.index) + by : 0;
    choose(order[Math.max(0, Math.min(order.length - 1, place))]);
  };
  const press = (event: KeyboardEvent) => {
    const edge = edgeKey(event);
    if (edge && chosen) stepMark(editing, view, chosen, edge.isEnd ? 'to' : 'from', edge.by_s);
    else if (event.ctrlKey || event.metaKey || event.altKey) return;
    else if (event.key === 'ArrowLeft') step(-1);
    else if (event.key === 'ArrowRight') step(1);
    else if (!chosen) return;
    else if (event.key === 'Enter' || event.key === 'F2') view.naming.set(chosen);
    else if (event.key === 'Delete' || event.key === 'Backspace') removeMark(editing, view, chosen);
    else return;
    takeKey(event);
  };
  const down = (event: PointerEvent) => {
    const target = event.target as HTMLElement;
    const item = target.closest<HTMLElement>('[data-index]');
    if (!item || event.button !== 0) return;
    const one = { kind, index: Number(item.dataset.index) };
    choose(one.index);
    const part = (target.dataset.part as SectionPart | undefined) ?? 'whole';
    const drag = dragMark(editing, view, one, part);
    if (drag) followPointer(event, view.scroller, drag);
  };
  const named = naming?.kind === kind ? items[naming.index] : undefined;
  const ends = kind === 'section' ? (['from', 'to'] as const) : [];
  return (
    <>
      <div
        ref={list}
        className={styles.marks}
        role="listbox"
        tabIndex={0}
        aria-label={kind === 'marker' ? 'Markers' : 'Sections'}
        aria-orientation="horizontal"
        aria-activedescendant={chosen ? `timeline-${kind}-${chosen.index}` : undefined}
        onFocus={() => (chosen ? undefined : choose(order[0]))}
        onPointerDown={down}
        onDoubleClick={() => view.naming.set(chosen)}
        onKeyDown={press}
      >
        {items.map((item, index) => (
          <div
            key={index}
            id={`timeline-${kind}-${index}`}
            className={kind === 'marker' ? styles.marker : styles.section}
            role="option"
            aria-selected={index === chosen?.index}
            aria-label={markText(show, { kind, index })}
            data-index={index}
            style={{
              left: xOf(axis, item.from_s),
              width: kind === 'section' ? (item.to_s - item.from_s) * axis.scale : undefined,
            }}
          >
            <span>{item.name}</span>
            {ends.map((part) => (
              <i key={part} className={styles.edge} data-part={part} />
            ))}
          </div>
        ))}
      </div>
      {named && naming ? (
        <div className={styles.naming} style={{ left: xOf(axis, named.from_s) }}>
          <NameField
            label={kind === 'marker' ? 'Name of the marker' : 'Name of the section'}
            name={named.name}
            onName={(name, isByKey) => {
              view.naming.set(null);
              if (name) renameMark(editing, naming, name);
              if (isByKey) list.current?.focus();
            }}
          />
        </div>
      ) : null}
    </>
  );
}
