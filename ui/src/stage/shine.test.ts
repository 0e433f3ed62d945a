import { expect, test } from 'vitest';
import { LIGHT_RADII, shineAt } from './shine';

test('a light is brightest in its middle, white there, and fades to nothing', () => {
  const steps = Array.from({ length: 41 }, (_, i) => shineAt((i / 40) * LIGHT_RADII));
  steps.slice(1).forEach((step, i) => {
    expect(step.glow).toBeLessThanOrEqual(steps[i]?.glow ?? 0);
    expect(step.core).toBeLessThanOrEqual(steps[i]?.core ?? 0);
  });
  expect(steps[0]?.core).toBeGreaterThan(0.3);
  expect(shineAt(1).core).toBeLessThan(0.05);
  expect(shineAt(1).glow).toBeGreaterThan(0.2);
  expect(shineAt(LIGHT_RADII)).toEqual({ glow: 0, core: 0 });
  expect(shineAt(LIGHT_RADII - 0.01).glow).toBeLessThan(1 / 255);
});
