import type { Rgb } from '../base/colour';
import { pixelAt, type Tool } from './tool';

/** Takes the colour of the pixel that is clicked. */
export function createEyedropper(taken: (color: Rgb) => void): Tool {
  return {
    down(editor, touch) {
      const id = pixelAt(editor, touch);
      const pixel = editor.current()?.pixels.find((p) => p.id === id);
      if (pixel) taken(pixel.color);
    },
    move() {},
    up() {},
    cancel: () => false,
  };
}
