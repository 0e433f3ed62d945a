import { IconBrackets, IconFlag, IconMovie } from '@tabler/icons-react';
import { useLayoutEffect, useRef, type KeyboardEvent } from 'react';
import { xOf, type Axis } from '../../model/timelineAxis';
import { markersOf, sectionsOf } from '../../model/timelineMarks';
import { useEditing } from '../context';
import { FramesLane } from './FramesLane';
import { LayerNames, LayerRows } from './LayerRows';
import { MarksLane } from './MarksLane';
import { Playhead } from './Playhead';
import { Rows, type TimelineRow } from './Rows';
import { Ruler } from './Ruler';
import { attachScroller } from './scroller';
import { fitTimeline } from './timelineDrag';
import { useTimelineView, zoomTimeline, ZOOM_STEP, type TrackProps } from './timelineView';
import styles from './Timeline.module.css';

/** The rows of the timeline, which scroll together. `rows`: further rows just above the frames. */
export function Tracks({
  show,
  blocks,
  axis,
  drawn,
  rows,
}: TrackProps & { rows: readonly TimelineRow[] }) {
  const editing = useEditing();
  const view = useTimelineView();
  const element = useScroller(axis);
  const width = xOf(axis, axis.to_s);
  const press = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTyping(event)) return;
    if (event.key === '+' || event.key === '=') zoomTimeline(view, ZOOM_STEP);
    else if (event.key === '-') zoomTimeline(view, 1 / ZOOM_STEP);
    else if (event.key === '0') fitTimeline(editing, view);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const tracks = { show, blocks, axis, drawn };
  const all: TimelineRow[] = [
    { title: '', height: 'ruler', lane: <Ruler axis={axis} drawn={drawn} /> },
    ...(sectionsOf(show).length > 0 ? [sectionsRow(tracks)] : []),
    ...(markersOf(show).length > 0 ? [markersRow(tracks)] : []),
    ...rows,
    {
      title: 'Frames',
      icon: <IconMovie size={16} />,
      height: 'frames',
      lane: <FramesLane {...tracks} />,
    },
  ];
  return (
    <div className={styles.tracks} ref={element} data-testid="timeline" onKeyDown={press}>
      <div className={styles.content}>
        <div className={styles.head} data-head>
          <Rows rows={all} width={width}>
            <Playhead blocks={blocks} axis={axis} isLabelled />
          </Rows>
        </div>
        <div className={styles.layers}>
          <LayerNames show={show} drawn={drawn} />
          <div className={styles.lanes} style={{ width }}>
            <LayerRows {...tracks} />
            <Playhead blocks={blocks} axis={axis} />
          </div>
        </div>
      </div>
    </div>
  );
}

const sectionsRow = (tracks: TrackProps): TimelineRow => ({
  title: 'Sections',
  icon: <IconBrackets size={16} />,
  height: 'marks',
  lane: <MarksLane kind="section" {...tracks} />,
});

const markersRow = (tracks: TrackProps): TimelineRow => ({
  title: 'Markers',
  icon: <IconFlag size={16} />,
  height: 'marks',
  lane: <MarksLane kind="marker" {...tracks} />,
});

const isTyping = ({ target }: KeyboardEvent) => (target as HTMLElement).tagName === 'INPUT';

/** A ref for the element that scrolls; attaches the view to the element. */
function useScroller(axis: Axis) {
  const view = useTimelineView();
  const element = useRef<HTMLDivElement>(null);
  const first = useRef(axis);
  useLayoutEffect(
    () => (element.current ? attachScroller(view, element.current, first.current) : undefined),
    [view],
  );
  return element;
}
