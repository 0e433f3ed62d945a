import { createStore, type Store } from '../base/store';
import type { Camera } from './camera';

/** Camera of a stage, and the size of its canvas, CSS pixels. `fitted`: the camera keeps the whole floor in view. */
export interface View {
  camera: Camera;
  fitted: boolean;
  width_px: number;
  height_px: number;
}

export const createView = (): Store<View> =>
  createStore<View>({
    camera: { scale: 200, originX_px: 0, originY_px: 0 },
    fitted: true,
    width_px: 1,
    height_px: 1,
  });
