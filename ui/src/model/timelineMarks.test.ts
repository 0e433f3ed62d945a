import { expect, test } from 'vitest';
import { readShow, writeShow } from './json';
import { newShow } from './show';
import * as marks from './timelineMarks';

const show = newShow('x', 2);
const DOCUMENT = {
  lightbots: 2,
  frames: [],
  markers: [{ name: 'Drum', at_s: 3, note: 'kept' }],
  sections: [{ name: 'Verse', from_s: 0, to_s: 8 }],
};

test('markers are added, moved, renamed and removed; a show without any stays version 1', () => {
  const one = marks.addMarker(show, 2.345);
  expect(marks.markersOf(one)).toEqual([{ name: 'Marker 1', at_s: 2.35, rest: {} }]);
  expect(writeShow(one)).toMatchObject({
    lightbots: 2,
    markers: [{ name: 'Marker 1', at_s: 2.35 }],
  });
  const two = marks.addMarker(one, -1);
  expect(marks.markersOf(two)[1]).toMatchObject({ name: 'Marker 2', at_s: 0 });
  const changed = marks.renameMarker(marks.moveMarker(two, 0, 9), 0, 'Drum');
  expect(marks.markersOf(changed)[0]).toMatchObject({ name: 'Drum', at_s: 9 });
  expect(marks.moveMarker(changed, 0, 9)).toBe(changed);
  expect(marks.moveMarker(changed, 7, 9)).toBe(changed);
  const none = marks.removeMarker(marks.removeMarker(changed, 1), 0);
  expect(writeShow(none)).toEqual(writeShow(show));
});

test('sections keep an end after their start', () => {
  const one = marks.addSection(show, 2, 1);
  expect(marks.sectionsOf(one)[0]).toMatchObject({ from_s: 2, to_s: 2.1 });
  const long = marks.moveSection(one, 0, 'to', 10);
  expect(marks.sectionsOf(marks.moveSection(long, 0, 'from', 20))[0]?.from_s).toBe(9.9);
  const moved = marks.moveSection(long, 0, 'whole', 4);
  expect(marks.sectionsOf(moved)[0]).toMatchObject({ from_s: 4, to_s: 12 });
  const late = marks.moveSection(long, 0, 'whole', 1e9);
  expect(marks.sectionsOf(late)[0]?.to_s).toBe(marks.LATEST_S);
  expect(marks.sectionsOf(marks.renameSection(moved, 0, 'Verse'))[0]?.name).toBe('Verse');
  expect(writeShow(marks.removeSection(moved, 0))).toEqual(writeShow(show));
});

test('fields that the screen does not know stay in the document', () => {
  const read = readShow(DOCUMENT);
  expect(marks.markersOf(read)).toBe(marks.markersOf(read));
  const moved = writeShow(marks.moveMarker(read, 0, 4)) as typeof DOCUMENT;
  expect(moved.markers).toEqual([{ name: 'Drum', at_s: 4, note: 'kept' }]);
  expect(moved.sections).toEqual(DOCUMENT.sections);
});
