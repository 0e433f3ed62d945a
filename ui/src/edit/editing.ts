import { getAsset } from '../api/http';
import type { MakeChoices, Plan } from '../api/types.gen';
import type { Rgb } from '../base/colour';
import { createStore, type Readable, type Store } from '../base/store';
import { startWorker } from '../make/browserWorker';
import { startLightWorker } from '../light/browserWorker';
import { createLights, type Lights } from '../light/lights';
import { createMaker, type Maker } from '../make/maker';
import type { Making } from '../make/making';
import { decodeMusic } from '../music/decode';
import { createMusic, type Music } from '../music/music';
import { createSounding, type Sounding } from '../music/sounding';
import { createFullPlan, type FullPlan } from '../session/fullPlan';
import { createEditor, type Editor } from '../model/editor';
import type { Keeper } from '../model/drafts';
import type { Saver } from '../model/saver';
import type { Motion } from '../model/motion';
import { createPreview, type Preview } from '../model/preview';
import type { Show } from '../model/show';
import { openShow } from '../session/openShow';
import type { Session } from '../session/session';
import { createView, type View } from '../stage/view';
import { followCopy } from '../session/copies';
import { createListening, type Listening } from './music/listening';
import { createSaving, draftOf, restoreDraft, type Saving } from './saving';
import { createSpaceHold, type SpaceHold } from './spaceHold';
import type { MenuAt } from './menuAt';
import { watchLeaving } from './watchLeaving';

/** A file that the user gave this screen for a show. */
export interface TakenFile {
  /** SHA-256 of the bytes, by which shows name the file. */
  hash: string;
  name: string;
  mediaType: string;
  bytes: Uint8Array<ArrayBuffer>;
}

export type ToolName = 'arrow' | 'hand' | 'lasso' | 'eyedropper' | 'fill' | 'area';

/** View options of this screen: what the stage shows and snaps to. */
export interface StageOptions {
  snap: boolean;
  ids: boolean;
  ghosts: boolean;
  routes: boolean;
}

/** A show that this screen edits, and the state of its editor. */
export interface Editing {
  /** Name in the library. Changes once, when a read-only show was saved as a copy and the copy is shown. */
  name: string;
  editor: Editor;
  saver: Saver;
  keeper: Keeper;
  /** The plan of this show; null: there is none yet, or another show is open. */
  plan: Readable<Plan | null>;
  /** The last finished plan of this show; null: there is none yet, or another show is open. */
  settled: Readable<Plan | null>;
  full: FullPlan;
  view: Store<View>;
  tool: Store<ToolName>;
  options: Store<StageOptions>;
  /** The colours used last, newest first, each once. */
  recent: Store<readonly Rgb[]>;
  /** Colour of the picker. */
  color: Store<Rgb>;
  preview: Preview;
  /** Makes frames from words, shapes and files; its worker starts with the first request. */
  maker: Maker;
  /** Colours of the layers of light. */
  lights: Lights;
  /** The music of the show. */
  music: Music;
  /** Music that is heard: in the preview, or by itself. */
  sounding: Sounding;
  listening: Listening;
  /** The layer whose settings and handles are shown, counted from the lowest; null: none. */
  layer: Store<number | null>;
  /** Whether the panel of layers is open: then light moves on the frame that is drawn. */
  lighting: Store<boolean>;
  /** Whether the settings of a motion are open: then the stage has its handles. */
  moving: Store<boolean>;
  /** The motion of the frame while a handle of it is dragged; null: none is. */
  motionDrawn: Store<Motion | null>;
  /** Fonts and shapes that settings of the Make panel may name; null until they are loaded. */
  choices: Store<MakeChoices | null>;
  /** The frame that is being made in the Make panel; null: the panel is closed. */
  making: Store<Making | null>;
  /** Files that this screen took, by hash; they reach the server when a frame uses them. */
  files: Map<string, TakenFile>;
  /** A file of the show by its hash: taken on this screen, or from the server. */
  fileOf(hash: string): Promise<Uint8Array<ArrayBuffer>>;
  /** The space key on the stage. */
  space: SpaceHold;
  /** Whether the audience view lies over the editor. */
  audience: Store<boolean>;
  /** The menu that is open on the stage; null: none. */
  menu: Store<MenuAt | null>;
  /** Index of the frame that is being renamed; null: none. */
  renaming: Store<number | null>;
  /** Saves unsaved changes and stops following the server, because another show is edited from now on. */
  retire(): void;
}

/** Most colours in `recent`. */
const RECENT_MAX = 10;

/** `wantedDraft`: the draft of a closed page to restore; null: the newest, if there is one. */
export function createEditing(
  session: Session,
  name: string,
  show: Show,
  etag: string | null,
  wantedDraft: string | null = null,
): Editing {
  const editor = createEditor(show, session.frame.get());
  const draft = draftOf(session, name, show, wantedDraft);
  const saving = createSaving(session.drafts, name, etag, editor, draft, (from, copy) =>
    followCopy(session, from, copy),
  );
  const { saver, keeper } = saving;
  const color = createStore<Rgb>(0xffc878);
  const maker = createMaker(startWorker);
  const files = new Map<string, TakenFile>();
  const fileOf = async (hash: string) => files.get(hash)?.bytes ?? (await getAsset(hash));
  const lights = createLights(startLightWorker, fileOf);
  const music = createMusic(fileOf, decodeMusic);
  music.follow(show);
  const sounding = createSounding(fileOf);
  let { selection } = editor.state.get();
  const unfollow = editor.state.subscribe(() => {
    const now = editor.state.get();
    session.frame.set(now.frame);
    music.follow(now.show);
    if (now.selection === selection) return;
    selection = now.selection;
    // The picker shows the colour of the selection.
    const [first] = editor.chosenPixels();
    if (first) color.set(first.color);
  });
  let stop = () => {};
  const preview = createPreview(editor);
  const tool = createStore<ToolName>('arrow');
  const whileOpen = (of: Readable<Plan | null>) => planOf(session.live, () => editing.name, of);
  const plan = whileOpen(session.live.plan);
  const editing: Editing = {
    name,
    editor,
    saver,
    keeper,
    plan,
    settled: whileOpen(session.live.settled),
    full: createFullPlan(plan),
    view: createView(),
    tool,
    options: createStore<StageOptions>({ snap: true, ids: false, ghosts: true, routes: false }),
    recent: createStore<readonly Rgb[]>([]),
    color,
    preview,
    maker,
    lights,
    music,
    sounding,
    listening: createListening(sounding),
    layer: createStore<number | null>(null),
    lighting: createStore(false),
    moving: createStore(false),
    motionDrawn: createStore<Motion | null>(null),
    choices: createStore<MakeChoices | null>(null),
    making: createStore<Making | null>(null),
    files,
    fileOf,
    space: createSpaceHold(() => tool.get() === 'hand', preview.toggle),
    audience: createStore(false),
    menu: createStore<MenuAt | null>(null),
    renaming: createStore<number | null>(null),
    retire() {
      saver.flush();
      maker.end();
      lights.end();
      editing.listening.stop();
      sounding.close();
      unfollow();
      stop();
      keeper.leave();
    },
  };
  if (draft) restoreDraft(session, editing, draft);
  const stops = [
    moveToCopy(session, editing, saving),
    followServer(session, editing),
    watchLeaving(editing),
  ];
  stop = () => stops.forEach((each) => each());
  return editing;
}

/** `plan` while the show open on the server has that name; else null. */
const planOf = (
  { opened }: Session['live'],
  name: () => string,
  plan: Readable<Plan | null>,
): Readable<Plan | null> => ({
  get: () => (opened.get().name === name() ? plan.get() : null),
  subscribe(listener) {
    const stops = [plan.subscribe(listener), opened.subscribe(listener)];
    return () => stops.forEach((stop) => stop());
  },
});

/** Switches to the copy of a read-only show when the copy is shown; opens the copy again after a broken connection. */
function moveToCopy(session: Session, editing: Editing, saving: Saving): () => void {
  const { live } = session;
  const stops = [
    session.shown.subscribe(() => {
      if (session.shown.get().name === saving.name()) editing.name = saving.name();
    }),
    live.link.subscribe(() => {
      const isDue = saving.name() !== editing.name && live.opened.get().name === editing.name;
      if (isDue && live.link.get() === 'open') void openShow(session, saving.name());
    }),
  ];
  return () => stops.forEach((stop) => stop());
}

/** Adopts versions that other screens save. Not during a gesture or with unsaved changes: saving finds the conflict. */
function followServer(session: Session, editing: Editing): () => void {
  const { editor, saver } = editing;
  const known = new Set([saver.etag(), session.live.opened.get().etag]);
  const look = () => {
    const opened = session.live.opened.get();
    if (opened.name !== editing.name || !opened.show || known.has(opened.etag)) return;
    if (saver.state.get().name !== 'saved' || editor.isGesturing()) return;
    known.add(opened.etag);
    editor.adopt(opened.show);
    saver.settle(opened.etag);
  };
  const stops = [
    saver.state.subscribe(() => {
      known.add(saver.etag());
      look();
    }),
    session.live.opened.subscribe(look),
  ];
  return () => stops.forEach((stop) => stop());
}

/** Makes a colour the current one, and adds it to the recent colours. */
export const keepColour = (editing: Editing, color: Rgb) => {
  editing.color.set(color);
  editing.recent.update((now) => [color, ...now.filter((c) => c !== color)].slice(0, RECENT_MAX));
};
