import { expect, test } from 'vitest';
import { createStore } from './store';

test('listeners hear changes, and only changes', () => {
  const store = createStore(1);
  const heard: number[] = [];
  const stop = store.subscribe(() => heard.push(store.get()));
  store.set(1);
  store.set(2);
  store.update((n) => n + 1);
  stop();
  store.set(9);
  expect(heard).toEqual([2, 3]);
});

test('a listener that leaves while being told does not disturb the others', () => {
  const store = createStore(0);
  let second = 0;
  const stop = store.subscribe(() => stop());
  store.subscribe(() => second++);
  store.set(1);
  store.set(2);
  expect(second).toBe(2);
});
