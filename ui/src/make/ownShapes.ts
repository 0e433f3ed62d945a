import { createStore, type Readable } from '../base/store';
import { readSources, writeSource } from '../model/jsonSources';
import type { FrameSource } from '../model/sources';

/** A source that a user named and keeps for other shows. */
export interface OwnShape {
  name: string;
  source: FrameSource;
}

/** The own shapes of this browser. */
export interface OwnShapes {
  list: Readable<readonly OwnShape[]>;
  /** Keeps a source under a name, in place of another one of that name; answers why not, or null. */
  save(name: string, source: FrameSource): string | null;
  remove(name: string): void;
}

/** The part of the browser's storage that is needed. */
export type ShapeStorage = Pick<Storage, 'getItem' | 'setItem'>;

const KEY = 'lightbots-own-shapes';

/** Most shapes that are kept. */
export const SHAPES_MAX = 100;

/**
 * Own shapes, kept in the browser's storage: they survive reloading, a restart of the server and the deletion of
 * shows. `storage`: null where the browser has none; then shapes last until the page is closed.
 */
export function createOwnShapes(storage: ShapeStorage | null): OwnShapes {
  const list = createStore<readonly OwnShape[]>(read(storage));
  const put = (next: readonly OwnShape[]): string | null => {
    try {
      storage?.setItem(KEY, JSON.stringify(next.map(written)));
    } catch {
      return 'The browser has no room left for this shape. Remove another one first.';
    }
    list.set(next);
    return null;
  };
  return {
    list,
    save(name, source) {
      // A file belongs to a show, and may be deleted with it.
      if (source.asset !== null) return 'Files are not kept as own shapes; choose the file again.';
      const others = list.get().filter((shape) => shape.name !== name);
      if (others.length >= SHAPES_MAX)
        return `There are ${SHAPES_MAX} own shapes. Remove one first.`;
      const kept = { ...source, moved: [], series: null };
      return put([...others, { name, source: kept }].sort((a, b) => a.name.localeCompare(b.name)));
    },
    remove: (name) => void put(list.get().filter((shape) => shape.name !== name)),
  };
}

const written = ({ name, source }: OwnShape) => ({ name, source: writeSource(source) });

/** The shapes in the storage; entries that are no shapes are left out. */
function read(storage: ShapeStorage | null): OwnShape[] {
  try {
    const found: unknown = JSON.parse(storage?.getItem(KEY) ?? '[]');
    return Array.isArray(found) ? found.slice(0, SHAPES_MAX).flatMap(shapeOf) : [];
  } catch {
    return [];
  }
}

function shapeOf(value: unknown): OwnShape[] {
  if (typeof value !== 'object' || value === null) return [];
  const { name, source } = value as Record<string, unknown>;
  const [found] = readSources([source]);
  return typeof name === 'string' && name !== '' && found ? [{ name, source: found }] : [];
}
