import { Stack, Text, Title } from '@mantine/core';
import type { Plan } from '../api/types.gen';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import { sizeText } from '../base/units';
import { useUnit } from '../session/preferences';
import { useSession } from '../session/session';
import { IssueList } from '../parts/IssueList';
import styles from './facts.module.css';

/** Figures of the open show, and its issues. */
export function ShowFacts() {
  const { live, frame } = useSession();
  const opened = useStore(live.opened);
  const plan = useStore(live.plan);
  const unit = useUnit();
  if (!opened.show)
    return (
      <Text c="dimmed" size="sm">
        No show is open.
      </Text>
    );
  const pixels = Math.max(0, ...opened.show.frames.map((f) => f.pixels.length));
  const { width_m, depth_m } = opened.show.stage;
  return (
    <Stack gap="md">
      <Title order={2} size="md">
        {opened.show.name || opened.name}
      </Title>
      <dl className={styles.facts}>
        <dt>Frames</dt>
        <dd>{opened.show.frames.length}</dd>
        <dt>Robots</dt>
        <dd>{pixels}</dd>
        <dt>Floor</dt>
        <dd>
          {sizeText(width_m, unit)} × {sizeText(depth_m, unit)}
        </dd>
        {plan ? <PlanFacts plan={plan} /> : null}
      </dl>
      {plan ? <IssueList issues={plan.issues} onFrame={(index) => frame.set(index)} /> : null}
    </Stack>
  );
}

function PlanFacts({ plan }: { plan: Plan }) {
  if (plan.planning)
    return (
      <>
        <dt>Plan</dt>
        <dd>being made…</dd>
      </>
    );
  return (
    <>
      <dt>Running time</dt>
      <dd>{clockText(plan.duration_s)}</dd>
      <dt>Closest</dt>
      <dd>
        {plan.closest_m === null
          ? '–'
          : `${(plan.closest_m * 1000).toFixed(0)} mm, centre to centre`}
      </dd>
      <dt>Stop-safe</dt>
      <dd>{stopSafeText(plan)}</dd>
      <dt>Plan</dt>
      <dd>{plan.ok ? 'proven: no two robots touch' : 'cannot be played as it is'}</dd>
    </>
  );
}

/** Share of moments at which any one robot may stop dead, and the frame with the least share on the drive to it. */
function stopSafeText(plan: Plan): string {
  if (!plan.ok || plan.transitions.length === 0) return '–';
  if (plan.stop_safe >= 1) return 'any one robot may stop dead at any moment';
  const least = plan.transitions.reduce((one, other) =>
    other.stop_safe < one.stop_safe ? other : one,
  );
  return `at ${percentText(plan.stop_safe)} of all moments; least on the way to frame ${least.to + 1}: ${percentText(least.stop_safe)}`;
}

/** A share, 0 to 1, as percent, rounded down to a tenth, so that 100 % means all. */
function percentText(share: number): string {
  return `${(Math.floor(share * 1000) / 10).toFixed(1)} %`;
}
