import { withRest } from './frameIds';
import type { Show } from './show';

/** A list in the document of a show that the screen keeps as JSON and reads when it is needed. */
export interface ListField<T> {
  /** The list in the order of the document; the same one for the same document. */
  of(show: Show): readonly T[];
  /** The show with another list; an empty one takes the field out. */
  with(show: Show, values: readonly T[]): Show;
}

export function listField<T>(
  field: string,
  read: (json: unknown) => T,
  write: (value: T) => unknown,
): ListField<T> {
  const known = new WeakMap<object, readonly T[]>();
  const none: readonly T[] = [];
  return {
    of(show) {
      const json = show.rest[field];
      if (!Array.isArray(json) || json.length === 0) return none;
      const values = known.get(json) ?? json.map(read);
      known.set(json, values);
      return values;
    },
    with(show, values) {
      const json = values.map(write);
      known.set(json, values);
      return withRest(show, field, json);
    },
  };
}
