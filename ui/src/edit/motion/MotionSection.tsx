import { Select, Stack } from '@mantine/core';
import { useEffect } from 'react';
import type { MotionKind } from '../../model/motion';
import { useEditing, useEditor } from '../context';
import { applyMotion, chooseMotion } from './motionActs';
import { MotionFields } from './MotionFields';

const WORDS: Readonly<Record<MotionKind, string>> = {
  travel: 'The picture travels',
  turn: 'The picture turns',
  breathe: 'The picture breathes',
  follow: 'Follow the leader',
  wave: 'A wave runs through',
  stagger: 'One after the other',
  morph: 'Through pictures in between',
};

/** Kinds with handles on the floor. */
const HANDLED: readonly MotionKind[] = ['travel', 'turn', 'breathe', 'follow'];

/** Kinds that the screen offers: a `morph` that is in the file is kept, but cannot be made here. */
const OFFERED: readonly MotionKind[] = ['travel', 'turn', 'breathe', 'follow', 'wave', 'stagger'];

/** How the picture before drives to the frame on the stage; nothing while several frames are chosen. */
export function MotionSection() {
  const editing = useEditing();
  const index = useEditor((s) => s.frame);
  const frame = useEditor((s) => s.show.frames[s.frame]);
  const hasOne = useEditor((s) => s.frames.size === 1);
  const { moving } = editing;
  useEffect(() => {
    moving.set(hasOne);
    return () => moving.set(false);
  }, [moving, hasOne]);
  if (!frame || !hasOne) return null;
  const { motion } = frame;
  const kinds = motion?.kind === 'morph' ? [...OFFERED, 'morph' as const] : OFFERED;
  const shortest = { value: '', label: 'The shortest drive' };
  return (
    <Stack gap="sm" component="section" aria-label="Way here">
      <Select
        label="Way here"
        description={
          index === 0
            ? 'The first frame has no picture before it that could move.'
            : motion && HANDLED.includes(motion.kind)
              ? 'Drag the points on the floor, or type.'
              : undefined
        }
        size="xs"
        allowDeselect={false}
        disabled={index === 0}
        data={[shortest, ...kinds.map((value) => ({ value, label: WORDS[value] }))]}
        value={motion?.kind ?? ''}
        onChange={(kind) =>
          chooseMotion(editing, kind === '' || kind === null ? null : (kind as MotionKind))
        }
      />
      {motion && index > 0 ? (
        <MotionFields motion={motion} set={(next) => void applyMotion(editing, next)} />
      ) : null}
    </Stack>
  );
}
