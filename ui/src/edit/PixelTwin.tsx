import { colourName } from '../base/colour';
import { useEditing, useEditor } from './context';

/** Most pixels in the list, because thousands do not help a screen reader. */
const LISTED_MAX = 200;

/** The first pixels of the frame as a hidden list, for screen readers and tests; a click chooses a pixel. */
export function PixelTwin() {
  const { editor } = useEditing();
  const pixels = useEditor((s) => s.show.frames[s.frame]?.pixels);
  const selection = useEditor((s) => s.selection);
  if (!pixels) return null;
  return (
    <ul
      className="hidden-text"
      role="listbox"
      aria-multiselectable
      aria-label="Pixels of the frame"
      data-testid="pixels"
    >
      {pixels.slice(0, LISTED_MAX).map((p) => (
        <li
          key={p.id}
          role="option"
          aria-selected={selection.has(p.id)}
          data-x={p.x.toFixed(4)}
          data-y={p.y.toFixed(4)}
          data-color={p.color.toString(16).padStart(6, '0')}
          onClick={() => editor.select([p.id])}
        >
          Pixel {p.id}, {colourName(p.color)}, at {p.x.toFixed(2)}, {p.y.toFixed(2)} metres
          {p.robot === null ? '' : ', pinned'}
        </li>
      ))}
    </ul>
  );
}
