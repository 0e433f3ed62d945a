/** Units of lengths on screen; the program uses metres. */
export type Unit = 'm' | 'cm' | 'mm' | 'ft' | 'in';

interface UnitWords {
  /** For labels. */
  name: string;
  metres: number;
  /** Decimals of a number in a field: its last digit is about a tenth of a millimetre. */
  digits: number;
  /** Step of a field's arrows, in the unit. */
  step: number;
}

export const UNITS: Record<Unit, UnitWords> = {
  m: { name: 'metres', metres: 1, digits: 4, step: 0.01 },
  cm: { name: 'centimetres', metres: 0.01, digits: 2, step: 1 },
  mm: { name: 'millimetres', metres: 0.001, digits: 1, step: 10 },
  ft: { name: 'feet', metres: 0.3048, digits: 4, step: 0.05 },
  in: { name: 'inches', metres: 0.0254, digits: 3, step: 0.5 },
};

export const isUnit = (text: unknown): text is Unit => typeof text === 'string' && text in UNITS;

/** A number for a field, rounded to the unit's decimals. */
export const inUnit = (metres: number, unit: Unit): number =>
  Number((metres / UNITS[unit].metres).toFixed(UNITS[unit].digits)) + 0;

export const fromUnit = (value: number, unit: Unit): number => value * UNITS[unit].metres;

/** A length with a fixed number of decimals, down to about a millimetre: `1.250 m`, `125.0 cm`. */
export const lengthText = (metres: number, unit: Unit): string =>
  `${(metres / UNITS[unit].metres).toFixed(Math.max(0, UNITS[unit].digits - 1))} ${unit}`;

/** A length without trailing zeros: `3 m`, `250 cm`. */
export const sizeText = (metres: number, unit: Unit): string => `${inUnit(metres, unit)} ${unit}`;
