/** Minutes and seconds, `0:07` or `12:34`; negative counts as 0, and what is no finite number gives `–:––`. */
export function clockText(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return '–:––';
  const whole = Math.max(0, Math.round(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}

/** Show time in seconds as `0:07`, or `−0:04` during the first drive, before the first frame's air time. */
export const momentText = (seconds: number) =>
  seconds <= -0.5 ? `−${clockText(-seconds)}` : clockText(seconds);

/** Seconds with one decimal and unit: `3.4 s`. */
export const secondsText = (seconds: number) => `${seconds.toFixed(1)} s`;

/** Seconds rounded to two decimals. */
export const shortSeconds = (seconds: number) => Number(seconds.toFixed(2));

/** An age as text: `now`, `4 s`, `3 min`. */
export function ageText(seconds: number): string {
  if (seconds < 1.5) return 'now';
  if (seconds < 100) return `${Math.round(seconds)} s`;
  return `${Math.round(seconds / 60)} min`;
}
