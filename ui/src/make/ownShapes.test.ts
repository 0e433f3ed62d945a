import { expect, test } from 'vitest';
import { newDraft, sourcesOf } from './draft';
import { createOwnShapes, SHAPES_MAX, type ShapeStorage } from './ownShapes';

function memory(first: string | null = null): ShapeStorage & { text: string | null } {
  const storage = {
    text: first,
    getItem: () => storage.text,
    setItem(_: string, text: string) {
      storage.text = text;
    },
  };
  return storage;
}

const star = sourcesOf({ ...newDraft('shape'), shape: 'star', turn: 0.5 })[0] ?? null;
if (!star) throw new Error('A star can be made.');

test('shapes are kept by name, replaced, found by the next page, and removed', () => {
  const storage = memory();
  const shapes = createOwnShapes(storage);
  expect(shapes.save('Star', { ...star, moved: [3], series: 's' })).toBeNull();
  expect(shapes.save('Arc', star)).toBeNull();
  expect(shapes.save('Star', { ...star, seed: 9 })).toBeNull();
  const next = createOwnShapes(storage);
  expect(next.list.get().map((shape) => shape.name)).toEqual(['Arc', 'Star']);
  expect(next.list.get()[1]?.source).toEqual({ ...star, seed: 9 });
  next.remove('Arc');
  expect(createOwnShapes(storage).list.get()).toHaveLength(1);
});

test('what cannot be kept says why', () => {
  const shapes = createOwnShapes(memory());
  expect(shapes.save('Logo', { ...star, kind: 'svg', asset: 'ab' })).toMatch(/Files/);
  for (let i = 0; i < SHAPES_MAX; i++) shapes.save(`${i}`, star);
  expect(shapes.save('one more', star)).toMatch(/100/);
  expect(shapes.save('0', star)).toBeNull();
  const full = createOwnShapes({
    getItem: () => null,
    setItem() {
      throw new Error('QuotaExceededError');
    },
  });
  expect(full.save('A', star)).toMatch(/no room/);
  expect(full.list.get()).toEqual([]);
});

test('what is no list of shapes is left out', () => {
  const names = (text: string) =>
    createOwnShapes(memory(text))
      .list.get()
      .map((s) => s.name);
  expect(names('{')).toEqual([]);
  expect(names('{"a": 1}')).toEqual([]);
  expect(names('[1, null, {"name": "A"}, {"name": "", "source": {"kind": "shape"}}]')).toEqual([]);
  expect(names('[{"name": "B", "source": {"kind": "shape"}}]')).toEqual(['B']);
  expect(createOwnShapes(null).save('A', star)).toBeNull();
});
