import { number, object, text, without } from './jsonFields';
import { listField } from './listField';
import type { Show } from './show';

/** A named moment of the show. Moments are in seconds of show time. */
export interface Marker {
  name: string;
  at_s: number;
  /** Fields of the document that the screen does not use, kept unchanged. */
  rest: Readonly<Record<string, unknown>>;
}

/** A named stretch of the show. */
export interface Section {
  name: string;
  from_s: number;
  to_s: number;
  rest: Readonly<Record<string, unknown>>;
}

/** Latest moment that a show may name, seconds: a day. */
export const LATEST_S = 86_400;
/** Shortest section, seconds. */
const SHORTEST_S = 0.1;

const MARKERS = listField('markers', readMarker, ({ name, at_s, rest }) => ({
  name,
  at_s,
  ...rest,
}));
const SECTIONS = listField('sections', readSection, ({ name, from_s, to_s, rest }) => ({
  name,
  from_s,
  to_s,
  ...rest,
}));

/** The markers of a show in the order of its document; the same list for the same document. */
export const markersOf = MARKERS.of;

/** The sections of a show in the order of its document; the same list for the same document. */
export const sectionsOf = SECTIONS.of;

function readMarker(value: unknown): Marker {
  const json = object(value);
  return {
    name: text(json.name),
    at_s: number(json.at_s, 0),
    rest: without(json, ['name', 'at_s']),
  };
}

function readSection(value: unknown): Section {
  const json = object(value);
  const from_s = number(json.from_s, 0);
  return {
    name: text(json.name),
    from_s,
    to_s: number(json.to_s, from_s),
    rest: without(json, ['name', 'from_s', 'to_s']),
  };
}

const withMarkers = MARKERS.with;
const withSections = SECTIONS.with;

/** The nearest moment between `from_s` and `to_s`, rounded to a hundredth of a second unless it is one of them. */
const moment = (seconds: number, from_s = 0, to_s = LATEST_S) =>
  Math.max(from_s, Math.min(to_s, Math.round(seconds * 100) / 100));

export const addMarker = (show: Show, at_s: number): Show => {
  const markers = markersOf(show);
  const name = freeName(markers, 'Marker');
  return withMarkers(show, [...markers, { name, at_s: moment(at_s), rest: {} }]);
};

export const addSection = (show: Show, from_s: number, to_s: number): Show => {
  const sections = sectionsOf(show);
  const name = freeName(sections, 'Section');
  const begin_s = moment(from_s, 0, LATEST_S - SHORTEST_S);
  const end_s = moment(to_s, begin_s + SHORTEST_S);
  return withSections(show, [...sections, { name, from_s: begin_s, to_s: end_s, rest: {} }]);
};

function freeName(taken: readonly { name: string }[], word: string): string {
  const names = new Set(taken.map(({ name }) => name));
  for (let n = 1; ; n++) if (!names.has(`${word} ${n}`)) return `${word} ${n}`;
}

export const moveMarker = (show: Show, index: number, at_s: number): Show =>
  changeMarker(show, index, (marker) => ({ ...marker, at_s: moment(at_s) }));

/** A part of a section that is moved: an end, or the whole of it. */
export type SectionPart = 'from' | 'to' | 'whole';

/** The show with an end of a section at `to_s` of show time, or with the whole section beginning at it. */
export function moveSection(show: Show, index: number, part: SectionPart, to_s: number): Show {
  return changeSection(show, index, (section) => {
    const { from_s, to_s: end_s } = section;
    if (part === 'from') return { ...section, from_s: moment(to_s, 0, end_s - SHORTEST_S) };
    if (part === 'to') return { ...section, to_s: moment(to_s, from_s + SHORTEST_S) };
    const begin_s = moment(to_s, 0, LATEST_S - (end_s - from_s));
    return { ...section, from_s: begin_s, to_s: moment(begin_s + (end_s - from_s)) };
  });
}

export const renameMarker = (show: Show, index: number, name: string): Show =>
  changeMarker(show, index, (marker) => ({ ...marker, name }));

export const renameSection = (show: Show, index: number, name: string): Show =>
  changeSection(show, index, (section) => ({ ...section, name }));

export const removeMarker = (show: Show, index: number): Show =>
  withMarkers(
    show,
    markersOf(show).filter((_, i) => i !== index),
  );

export const removeSection = (show: Show, index: number): Show =>
  withSections(
    show,
    sectionsOf(show).filter((_, i) => i !== index),
  );

function changeMarker(show: Show, index: number, change: (marker: Marker) => Marker): Show {
  const markers = markersOf(show);
  const [before] = markers.slice(index, index + 1);
  const after = before && change(before);
  if (!after || (after.at_s === before.at_s && after.name === before.name)) return show;
  return withMarkers(
    show,
    markers.map((one, i) => (i === index ? after : one)),
  );
}

function changeSection(show: Show, index: number, change: (section: Section) => Section): Show {
  const sections = sectionsOf(show);
  const [before] = sections.slice(index, index + 1);
  const after = before && change(before);
  if (!after) return show;
  const { name, from_s, to_s } = after;
  if (name === before.name && from_s === before.from_s && to_s === before.to_s) return show;
  return withSections(
    show,
    sections.map((one, i) => (i === index ? after : one)),
  );
}
