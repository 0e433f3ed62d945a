/** Fields of parsed JSON; a field of another kind counts as missing. */
export type Json = Record<string, unknown>;

export const object = (value: unknown): Json =>
  typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Json) : {};
export const list = (value: unknown): unknown[] => (Array.isArray(value) ? value : []);
export const number = (value: unknown, otherwise: number) =>
  typeof value === 'number' && Number.isFinite(value) ? value : otherwise;
export const text = (value: unknown) => (typeof value === 'string' ? value : '');
export const pair = (value: unknown): [number, number] => {
  const numbers = list(value);
  return [number(numbers[0], 0), number(numbers[1], 0)];
};

/** The fields of an object without those in `known`. */
export function without(json: Json, known: readonly string[]): Json {
  return Object.fromEntries(Object.entries(json).filter(([key]) => !known.includes(key)));
}
