import { shortSeconds } from '../../base/time';
import type { Show } from '../../model/show';
import * as marks from '../../model/timelineMarks';
import type { Editing } from '../editing';
import { chosenFrames } from './blockActs';
import type { PointerDrag } from './followPointer';
import { blocksNow, dragOf, playhead_s } from './timelineDrag';
import type { ChosenMark, TimelineView } from './timelineView';

export function addMarker(editing: Editing, view: TimelineView) {
  const at_s = playhead_s(editing, blocksNow(editing, view));
  editing.editor.change('Add marker', (show) => marks.addMarker(show, at_s));
  nameLast(editing, view, 'marker');
}

/** Adds a section from the first drive of the chosen frames to their last air time, and lets the user name it. */
export function addSection(editing: Editing, view: TimelineView) {
  const blocks = blocksNow(editing, view);
  const chosen = chosenFrames(editing).flatMap((index) => blocks[index] ?? []);
  const [first, last] = [chosen[0], chosen[chosen.length - 1]];
  if (!first || !last) return;
  editing.editor.change('Add section', (show) =>
    marks.addSection(show, Math.max(0, first.driveFrom_s), last.until_s),
  );
  nameLast(editing, view, 'section');
}

function nameLast({ editor }: Editing, view: TimelineView, kind: ChosenMark['kind']) {
  const { show } = editor.state.get();
  const list = kind === 'marker' ? marks.markersOf(show) : marks.sectionsOf(show);
  const mark = { kind, index: list.length - 1 };
  view.mark.set(mark);
  view.naming.set(mark);
}

export const renameMark = ({ editor }: Editing, { kind, index }: ChosenMark, name: string) =>
  editor.change(kind === 'marker' ? 'Rename marker' : 'Rename section', (show) =>
    kind === 'marker'
      ? marks.renameMarker(show, index, name)
      : marks.renameSection(show, index, name),
  );

export function removeMark({ editor }: Editing, view: TimelineView, { kind, index }: ChosenMark) {
  editor.change(kind === 'marker' ? 'Delete marker' : 'Delete section', (show) =>
    kind === 'marker' ? marks.removeMarker(show, index) : marks.removeSection(show, index),
  );
  view.mark.set(null);
  view.status.set(kind === 'marker' ? 'Marker deleted' : 'Section deleted');
}

/** Show time of a part of a mark, seconds: of a marker its moment, of a section its begin or end. */
export function markMoment(show: Show, { kind, index }: ChosenMark, part: marks.SectionPart) {
  if (kind === 'marker') return marks.markersOf(show)[index]?.at_s;
  const section = marks.sectionsOf(show)[index];
  return part === 'to' ? section?.to_s : section?.from_s;
}

const moved = (show: Show, { kind, index }: ChosenMark, part: marks.SectionPart, to_s: number) =>
  kind === 'marker'
    ? marks.moveMarker(show, index, to_s)
    : marks.moveSection(show, index, part, to_s);

/** A marker or section with its moments, as text for people; empty: there is no such mark. */
export function markText(show: Show, { kind, index }: ChosenMark): string {
  if (kind === 'marker') {
    const marker = marks.markersOf(show)[index];
    return marker ? `Marker ${marker.name} at ${shortSeconds(marker.at_s)} s` : '';
  }
  const section = marks.sectionsOf(show)[index];
  if (!section) return '';
  return `Section ${section.name} from ${shortSeconds(section.from_s)} s to ${shortSeconds(section.to_s)} s`;
}

export const sayMark = ({ editor }: Editing, view: TimelineView, mark: ChosenMark) =>
  view.status.set(markText(editor.state.get().show, mark));

export function dragMark(
  editing: Editing,
  view: TimelineView,
  mark: ChosenMark,
  part: marks.SectionPart,
): PointerDrag | null {
  const from_s = markMoment(editing.editor.state.get().show, mark, part);
  if (from_s === undefined) return null;
  return dragOf(
    editing,
    view,
    mark.kind === 'marker' ? 'Move marker' : 'Move section',
    { what: mark.kind, index: mark.index },
    from_s,
    (show, _, to_s) => moved(show, mark, part, to_s),
    () => sayMark(editing, view, mark),
  );
}

export function stepMark(
  editing: Editing,
  view: TimelineView,
  mark: ChosenMark,
  part: marks.SectionPart,
  by_s: number,
) {
  const label = mark.kind === 'marker' ? 'Move marker' : 'Move section';
  editing.editor.change(label, (show) => {
    const at_s = markMoment(show, mark, part);
    return at_s === undefined ? show : moved(show, mark, part, at_s + by_s);
  });
  sayMark(editing, view, mark);
}
