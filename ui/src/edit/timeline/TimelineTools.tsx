import {
  IconArrowAutofitWidth,
  IconBrackets,
  IconFlag,
  IconMagnet,
  IconMinus,
  IconPlus,
} from '@tabler/icons-react';
import { memo, type ReactNode } from 'react';
import { useStore } from '../../base/store';
import { IconButton } from '../../parts/IconButton';
import { useEditing } from '../context';
import { FrameButtons } from '../FrameButtons';
import { addMarker, addSection } from './markActs';
import { fitTimeline } from './timelineDrag';
import { useTimelineView, zoomTimeline, ZOOM_STEP } from './timelineView';
import styles from './Timeline.module.css';

/** The bar over the timeline: buttons for frames, marks, snapping and zoom; in the middle, what was done last. */
export const TimelineTools = memo(function TimelineTools() {
  const editing = useEditing();
  const view = useTimelineView();
  const snaps = useStore(view.snaps);
  const button = (label: string, act: () => void, icon: ReactNode) => (
    <IconButton label={label} position="top" size="lg" onClick={act}>
      {icon}
    </IconButton>
  );
  return (
    <div className={styles.tools} role="toolbar" aria-label="Timeline tools">
      <FrameButtons position="top" />
      {button('Add a marker here', () => addMarker(editing, view), <IconFlag size={17} />)}
      {button(
        'Add a section over the chosen frames',
        () => addSection(editing, view),
        <IconBrackets size={17} />,
      )}
      <Status />
      <IconButton
        label="Snap (Alt: not now)"
        position="top"
        size="lg"
        variant={snaps ? 'filled' : 'subtle'}
        aria-pressed={snaps}
        onClick={() => view.snaps.set(!snaps)}
      >
        <IconMagnet size={17} />
      </IconButton>
      {button(
        'Zoom the timeline out (−)',
        () => zoomTimeline(view, 1 / ZOOM_STEP),
        <IconMinus size={17} />,
      )}
      {button(
        'Zoom the timeline in (+)',
        () => zoomTimeline(view, ZOOM_STEP),
        <IconPlus size={17} />,
      )}
      {button(
        'Whole timeline (0)',
        () => fitTimeline(editing, view),
        <IconArrowAutofitWidth size={18} />,
      )}
    </div>
  );
});

/** What was done last. A component of its own, because every step of a drag changes it. */
function Status() {
  const status = useStore(useTimelineView().status);
  return (
    <span className={styles.status} role="status" title={status}>
      {status}
    </span>
  );
}
