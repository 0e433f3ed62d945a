import { Slider } from '@mantine/core';
import { useMemo } from 'react';
import { useStore } from '../base/store';
import { clockText } from '../base/time';
import { timelineOf, totalOf } from '../model/timeline';
import page from '../parts/page.module.css';
import { useEditing, useEditor } from './context';
import styles from './EditBar.module.css';

/** The moment of the show that the floor shows. It stands alone, because each picture of a preview draws it anew. */
export function Scrubber() {
  const { preview, settled } = useEditing();
  const show = useEditor((s) => s.show);
  const frame = useEditor((s) => s.frame);
  const time_s = useStore(preview.time_s);
  const plan = useStore(settled);
  const timeline = useMemo(() => timelineOf(show, plan), [show, plan]);
  const total = totalOf(timeline);
  const at = time_s ?? timeline[frame]?.shownFrom_s ?? 0;
  return (
    <>
      <Slider
        className={page.progress}
        size="sm"
        label={clockText}
        thumbLabel="Moment of the show"
        min={0}
        max={Math.max(total, 0.1)}
        step={0.05}
        value={at}
        onChange={(to_s) => preview.scrub(timeline, to_s)}
      />
      <span className={`quiet ${styles.time}`}>
        {clockText(at)} / {clockText(total)}
      </span>
    </>
  );
}
