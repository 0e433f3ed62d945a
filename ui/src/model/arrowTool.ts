import { NO_OVERLAY } from './editorState';
import { type Point, boxBetween, inBox } from '../base/geometry';
import { placePixels } from './commands';
import { type Editor } from './editor';
import { wholeGroups } from './groups';
import { snap } from './snap';
import { pixelAt, type Tool, type Touch } from './tool';

export interface ArrowOptions {
  /** Grid step to snap to, metres; 0: none. */
  grid_m(): number;
  neighbours(): boolean;
  /** A length as text with its unit. */
  lengthText(metres: number): string;
}

type Phase =
  | { name: 'idle' }
  /** Pressed on a pixel: a click or the beginning of a drag. */
  | { name: 'pressed'; from: Point; hit: number; wasChosen: boolean }
  | {
      name: 'dragging';
      from: Point;
      lead: Point;
      places: ReadonlyMap<number, Point>;
      others: Point[];
    }
  | { name: 'marquee'; from: Point; before: ReadonlySet<number> };

/** Ids of the pixels that a click on pixel `hit` means: its whole group, but with Alt or a double click it alone. */
const meant = (editor: Editor, hit: number, { alt, again }: Touch): Iterable<number> =>
  alt || again ? [hit] : wholeGroups(editor.current(), [hit]);

/** Selects pixels by click and by marquee (a rectangle), and drags the selection. Shift adds, or removes by a click. */
export function createArrowTool(options: ArrowOptions): Tool {
  let phase: Phase = { name: 'idle' };

  const press = (editor: Editor, touch: Touch) => {
    const { selection } = editor.state.get();
    const hit = pixelAt(editor, touch);
    if (hit === null) {
      const before = touch.shift ? selection : new Set<number>();
      if (!touch.shift) editor.select([]);
      phase = { name: 'marquee', from: touch.at, before };
      return;
    }
    const wasChosen = selection.has(hit);
    const ids = meant(editor, hit, touch);
    if (touch.shift && !wasChosen) editor.select([...selection, ...ids]);
    else if (!wasChosen) editor.select(ids);
    phase = { name: 'pressed', from: touch.at, hit, wasChosen };
  };

  const startDrag = (editor: Editor, from: Point, hit: number): Phase => {
    const chosen = editor.state.get().selection;
    const pixels = editor.current()?.pixels ?? [];
    const lead = pixels.find((p) => p.id === hit) ?? { x: from.x, y: from.y };
    editor.begin();
    return {
      name: 'dragging',
      from,
      lead: { x: lead.x, y: lead.y },
      places: new Map(
        pixels.filter((p) => chosen.has(p.id)).map((p) => [p.id, { x: p.x, y: p.y }]),
      ),
      others: pixels.filter((p) => !chosen.has(p.id)),
    };
  };

  const drag = (editor: Editor, touch: Touch, now: Phase & { name: 'dragging' }) => {
    let [dx, dy] = [touch.at.x - now.from.x, touch.at.y - now.from.y];
    if (touch.shift) [dx, dy] = Math.abs(dx) >= Math.abs(dy) ? [dx, 0] : [0, dy];
    const free = touch.alt || touch.ctrl;
    const snapped = snap(now.lead, dx, dy, {
      grid_m: free ? 0 : options.grid_m(),
      reach_m: touch.reach_m * 0.6,
      neighbours: free || !options.neighbours() ? [] : now.others,
    });
    const places = new Map(
      [...now.places].map(([id, p]) => [id, { x: p.x + snapped.dx, y: p.y + snapped.dy }]),
    );
    editor.change('Move', (show, s) => placePixels(show, s.frame, places));
    editor.overlay({
      ...NO_OVERLAY,
      guides: snapped.guides,
      hint: dragHint(now, snapped, now.others, options.lengthText),
    });
  };

  return {
    down: press,
    move(editor, touch) {
      if (phase.name === 'pressed') {
        const far = Math.hypot(touch.at.x - phase.from.x, touch.at.y - phase.from.y);
        if (far < touch.reach_m * 0.4) return;
        phase = startDrag(editor, phase.from, phase.hit);
      }
      if (phase.name === 'dragging') drag(editor, touch, phase);
      if (phase.name === 'marquee') {
        const box = boxBetween(phase.from, touch.at);
        const inside = editor.current()?.pixels.filter((p) => inBox(p, box)) ?? [];
        const ids = inside.map((p) => p.id);
        const all = touch.alt ? ids : wholeGroups(editor.current(), ids);
        editor.select([...phase.before, ...all]);
        const { from } = phase;
        const corners = [
          from,
          { x: touch.at.x, y: from.y },
          touch.at,
          { x: from.x, y: touch.at.y },
        ];
        editor.overlay({ ...NO_OVERLAY, marquee: corners });
      }
    },
    up(editor, touch) {
      if (phase.name === 'dragging') editor.commit('Move');
      else if (phase.name === 'marquee') editor.overlay(NO_OVERLAY);
      else if (phase.name === 'pressed' && phase.wasChosen) {
        const { hit } = phase;
        const { selection } = editor.state.get();
        const ids = new Set(meant(editor, hit, touch));
        editor.select(touch.shift ? [...selection].filter((id) => !ids.has(id)) : ids);
      }
      phase = { name: 'idle' };
    },
    cancel(editor) {
      const busy = phase.name !== 'idle';
      phase = { name: 'idle' };
      editor.cancel();
      editor.overlay(NO_OVERLAY);
      return busy;
    },
  };
}

/** Place of the dragged pixel, length of the drag, and distance to the nearest pixel that stays, if below 1 m. */
function dragHint(
  now: { lead: Point; places: ReadonlyMap<number, Point> },
  by: { dx: number; dy: number },
  others: readonly Point[],
  text: (metres: number) => string,
): string {
  const at = { x: now.lead.x + by.dx, y: now.lead.y + by.dy };
  const nearest = Math.min(...others.map((p) => Math.hypot(p.x - at.x, p.y - at.y)));
  const went = Math.hypot(by.dx, by.dy);
  const place = `${text(at.x)}, ${text(at.y)} · moved ${text(went)}`;
  return nearest < 1 ? `${place} · nearest ${text(nearest)}` : place;
}
