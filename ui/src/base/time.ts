/** `0:07`, `12:34` from seconds; what is no number is shown as a dash. */
export function clockText(seconds: number | null | undefined): string {
  if (seconds === null || seconds === undefined || !Number.isFinite(seconds)) return '–:––';
  const whole = Math.max(0, Math.round(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}

/** `0:07`, or `−0:04` for a moment of the first drive: show time begins with the first frame's air time. */
export const momentText = (seconds: number) =>
  seconds <= -0.5 ? `−${clockText(-seconds)}` : clockText(seconds);

/** `3.4 s`. */
export const secondsText = (seconds: number) => `${seconds.toFixed(1)} s`;

/** Seconds with as few decimals as needed, at most two. */
export const shortSeconds = (seconds: number) => Number(seconds.toFixed(2));

/** An age as text: `now`, `4 s`, `3 min`. */
export function ageText(seconds: number): string {
  if (seconds < 1.5) return 'now';
  if (seconds < 100) return `${Math.round(seconds)} s`;
  return `${Math.round(seconds / 60)} min`;
}
