import { Slider } from '@mantine/core';
import { useMemo } from 'react';
import { useStore } from '../base/store';
import { momentText } from '../base/time';
import { timelineOf, totalOf } from '../model/timeline';
import page from '../parts/page.module.css';
import { useEditing, useEditor } from './context';
import styles from './EditBar.module.css';

/** A slider for the moment that the stage shows. A component of its own, because it is drawn anew during a preview. */
export function Scrubber() {
  const { preview, settled } = useEditing();
  const show = useEditor((s) => s.show);
  const frame = useEditor((s) => s.frame);
  const time_s = useStore(preview.time_s);
  const plan = useStore(settled);
  const timeline = useMemo(() => timelineOf(show, plan), [show, plan]);
  const total = totalOf(timeline);
  // Show time begins with the first frame's air time, as on the timeline.
  const begin = timeline[0]?.shownFrom_s ?? 0;
  const at = time_s ?? timeline[frame]?.shownFrom_s ?? 0;
  return (
    <>
      <Slider
        className={page.progress}
        size="sm"
        label={(to_s) => momentText(to_s - begin)}
        thumbLabel="Moment of the show"
        min={0}
        max={Math.max(total, 0.1)}
        step={0.05}
        value={at}
        onChange={(to_s) => preview.scrub(timeline, to_s)}
      />
      <span className={`quiet ${styles.time}`}>
        {momentText(at - begin)}
        <span className="wide-only"> / {momentText(total - begin)}</span>
      </span>
    </>
  );
}
