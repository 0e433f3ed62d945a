import { IconAlertTriangle, IconCircleCheck, IconInfoCircle } from '@tabler/icons-react';

const ICONS = {
  good: IconCircleCheck,
  care: IconAlertTriangle,
  bad: IconAlertTriangle,
  none: IconInfoCircle,
} as const;

/** The sign of a verdict, which says with it what its colour says. */
export function VerdictIcon({ tone, size }: { tone: keyof typeof ICONS; size: number }) {
  const Icon = ICONS[tone];
  return <Icon size={size} aria-hidden />;
}
