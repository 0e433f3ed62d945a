/**
 * Whether the last input was a key, and whether the focus came by one. `:focus-visible` does not tell: browsers turn
 * it on with the next key, whichever it is, also on a button that was clicked.
 */
let [isKeyLast, isByKeyboard] = [false, false];

export const isFocusByKeyboard = () => isByKeyboard;

/** Records in the page's `data-focus` how the focus moved last: `keyboard` or `pointer`. Style sheets use it. */
export function followFocus(page: Document) {
  const say = (byKeyboard: boolean) => {
    isByKeyboard = byKeyboard;
    page.documentElement.dataset.focus = byKeyboard ? 'keyboard' : 'pointer';
  };
  const capture = { capture: true, passive: true };
  page.addEventListener('keydown', () => void (isKeyLast = true), capture);
  page.addEventListener(
    'pointerdown',
    () => {
      isKeyLast = false;
      say(false);
    },
    capture,
  );
  page.addEventListener('focusin', () => say(isKeyLast), capture);
}
