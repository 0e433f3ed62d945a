import { Stack, Text, Title } from '@mantine/core';
import type { Plan } from '../api/types.gen';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import { sizeText } from '../base/units';
import { useUnit } from '../shell/preferences';
import { useSession } from '../shell/session';
import { IssueList } from './IssueList';

/** The open show in numbers, and what is wrong with it. */
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
      <dl className="facts">
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
      <dt>Plan</dt>
      <dd>{plan.ok ? 'proven: nobody touches' : 'cannot be played as it is'}</dd>
    </>
  );
}
