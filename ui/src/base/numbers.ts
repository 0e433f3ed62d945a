/** The numbers that a field accepts. */
export interface NumberRule {
  min: number;
  max: number;
  /** Only whole numbers. */
  whole?: boolean;
  /** The unit after a limit, such as ` s`. */
  unit?: string;
}

/** The typed number, or a message about the mistake in the typed text. */
export type Typed = { ok: true; value: number } | { ok: false; problem: string };

const NUMBER = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)$/;
const refuse = (problem: string): Typed => ({ ok: false, problem });

/** Reads a typed number: decimals after a point or a comma, no separators between thousands. */
export function readNumber(text: string, { min, max, whole, unit = '' }: NumberRule): Typed {
  const plain = text.trim().replace(/^\u2212/, '-');
  if (plain === '') return refuse('Type a number');
  if (!NUMBER.test(plain)) return refuse('This is not a number');
  const value = Number(plain.replace(',', '.'));
  if (whole && (/[.,]/.test(plain) || !Number.isInteger(value)))
    return refuse('Type a whole number');
  if (value < min) return refuse(`At least ${min}${unit}`);
  if (value > max) return refuse(`At most ${max}${unit}`);
  return { ok: true, value: value + 0 };
}

/** The next multiple of the step above (`up`) or below the value, limited to `min` and `max`. */
export function stepped(
  value: number,
  step: number,
  up: boolean,
  { min, max }: NumberRule,
): number {
  const steps = up ? Math.floor(value / step + 1e-9) + 1 : Math.ceil(value / step - 1e-9) - 1;
  return Math.min(max, Math.max(min, Number((steps * step).toFixed(6))));
}

/** A count with its noun: `1 frame`, `2 frames`. */
export const countText = (count: number, noun: string) =>
  `${count} ${noun}${count === 1 ? '' : 's'}`;
