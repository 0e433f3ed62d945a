import type { Axis } from '../../model/timelineAxis';
import { firstScale, namesWidth, noteSeen, zoomTimeline, type TimelineView } from './timelineView';

/** Exponent of the zoom for each unit of `deltaY` of a wheel with Ctrl. */
const WHEEL = 0.0025;

/**
 * Connects the timeline's view with the element that scrolls: sets the first zoom, notes which part is seen, and
 * zooms by the wheel with Ctrl. Returns a function that ends this.
 */
export function attachScroller(view: TimelineView, scroller: HTMLElement, axis: Axis): () => void {
  view.scroller = scroller;
  view.scale.set(firstScale(view, axis));
  const see = () => noteSeen(view);
  const zoom = (event: WheelEvent) => {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    const at_px = event.clientX - scroller.getBoundingClientRect().left - namesWidth(view);
    zoomTimeline(view, Math.exp(-event.deltaY * WHEEL), Math.max(0, at_px));
  };
  const observer = new ResizeObserver(see);
  observer.observe(scroller);
  scroller.addEventListener('scroll', see, { passive: true });
  scroller.addEventListener('wheel', zoom, { passive: false });
  see();
  return () => {
    view.scroller = null;
    observer.disconnect();
    scroller.removeEventListener('scroll', see);
    scroller.removeEventListener('wheel', zoom);
  };
}
