import { IconAlertTriangle, IconCircleCheck, IconInfoCircle } from '@tabler/icons-react';

const ICONS = {
  good: IconCircleCheck,
  care: IconAlertTriangle,
  bad: IconAlertTriangle,
  none: IconInfoCircle,
} as const;

/** An icon for the tone of a verdict, because colour must not be the only sign. */
export function VerdictIcon({ tone, size }: { tone: keyof typeof ICONS; size: number }) {
  const Icon = ICONS[tone];
  return <Icon size={size} aria-hidden />;
}
