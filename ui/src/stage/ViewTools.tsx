import { ActionIcon, Tooltip } from '@mantine/core';
import { IconMaximize, IconMinus, IconPlus } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import type { Point } from '../base/geometry';
import type { Store } from '../base/store';
import { zoomAt } from './camera';
import type { View } from './view';
import styles from './stage.module.css';

export const fitView = (view: Store<View>) => view.update((now) => ({ ...now, fitted: true }));

/** Shorter side of the view around a place that was searched for, at most, metres. */
const AROUND_M = 1.2;

/** Shows a place, stage metres, in the middle of the view; zooms in to `AROUND_M` if the view is wider. */
export const showPlace = (view: Store<View>, at: Point) =>
  view.update((now) => {
    const least = Math.min(now.width_px, now.height_px) / AROUND_M;
    const scale = Math.max(now.camera.scale, least);
    const camera = {
      scale,
      originX_px: now.width_px / 2 - at.x * scale,
      originY_px: now.height_px / 2 + at.y * scale,
    };
    return { ...now, fitted: false, camera };
  });

/** Zooms by a factor about the middle of the view. */
export const zoomView = (view: Store<View>, factor: number) =>
  view.update((now) => ({
    ...now,
    fitted: false,
    camera: zoomAt(now.camera, { x: now.width_px / 2, y: now.height_px / 2 }, factor),
  }));

/** A button that lies on the dark floor in both colour schemes. */
export function StageTool(props: {
  label: string;
  active?: boolean;
  onClick: () => void;
  children: ReactNode;
}) {
  return (
    <Tooltip label={props.label} position="bottom">
      <ActionIcon
        className={styles.tool}
        variant="transparent"
        aria-label={props.label}
        aria-pressed={props.active}
        data-active={props.active || undefined}
        onClick={props.onClick}
      >
        {props.children}
      </ActionIcon>
    </Tooltip>
  );
}

export function ZoomTools({ view }: { view: Store<View> }) {
  return (
    <>
      <StageTool label="Zoom out (−)" onClick={() => zoomView(view, 1 / 1.4)}>
        <IconMinus size={17} />
      </StageTool>
      <StageTool label="Zoom in (+)" onClick={() => zoomView(view, 1.4)}>
        <IconPlus size={17} />
      </StageTool>
      <StageTool label="Fit floor (0)" onClick={() => fitView(view)}>
        <IconMaximize size={17} />
      </StageTool>
    </>
  );
}
