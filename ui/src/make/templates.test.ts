import { expect, test } from 'vitest';
import { realMaker } from './realMaker.testing';
import { floorFor, makeTemplateFrame } from './templateShow';
import { TEMPLATES, wordShow } from './templates';

const shows = (robots: number) => [
  ...TEMPLATES.map(({ title, frames }) => ({ title, frames: frames(robots) })),
  { title: 'words', frames: wordShow('HELLO') },
];

test.each([3, 12, 30, 100])(
  'every frame of every template has a place for each of %i robots',
  async (robots) => {
    const maker = realMaker();
    const stage = floorFor(robots);
    for (const { title, frames } of shows(robots))
      for (const [nth, wanted] of frames.entries()) {
        const made = await makeTemplateFrame(maker, wanted, robots, stage, 'quick');
        const about = `${title} ${nth + 1}: ${made?.answer.error?.message}`;
        expect(made?.answer.error, about).toBeNull();
        expect(made?.frame.pixels, about).toHaveLength(robots);
        const reach_m = stage.width_m / 2;
        const isOn = made?.frame.pixels.every(
          ({ x, y }) => Math.abs(x) < reach_m && Math.abs(y) < reach_m,
        );
        expect(isOn, about).toBe(true);
        if (robots >= 30 && made?.answer.readability && title !== 'words')
          expect(made.answer.readability.readable, `${about} readable`).toBe(true);
      }
  },
  60_000,
);

test('there are ten templates with names of their own', () => {
  expect(new Set(TEMPLATES.map(({ title }) => title)).size).toBe(10);
  for (const { frames, face } of TEMPLATES) expect(frames(30)[face]).toBeDefined();
});

test('larger fleets get larger floors', () => {
  expect([30, 250, 1000, 2000].map((robots) => floorFor(robots).width_m)).toEqual([
    3, 6, 11.5, 16.5,
  ]);
});

test('a heart that beats is larger and smaller', async () => {
  const heartbeat = TEMPLATES.find(({ id }) => id === 'heartbeat');
  const frames = heartbeat?.frames(30) ?? [];
  const maker = realMaker();
  const sizes: number[] = [];
  for (const wanted of frames.slice(0, 2)) {
    const made = await makeTemplateFrame(maker, wanted, 30, floorFor(30), 'quick');
    sizes.push(made?.answer.size_m ?? 0);
  }
  expect((sizes[1] ?? 0) / (sizes[0] ?? 1)).toBeGreaterThan(1.15);
});
