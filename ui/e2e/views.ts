import type { Page } from 'playwright-core';
import { eventually, startRobots, type Server } from './harness';
import {
  beginEmpty,
  button,
  countIs,
  hold,
  openShow,
  phaseIs,
  pixelsAre,
  smallShow,
  uploadText,
} from './journeys';

/** A state of the screen, for pictures and for checks by axe. */
export interface View {
  name: string;
  /** Leads to this view from the one before it in its list. */
  show(page: Page, server: Server): Promise<void>;
  /** Leads away from it, so that the next view can be shown. */
  leave?(page: Page): Promise<void>;
}

const goLive = (page: Page, server: Server) => page.goto(`${server.url}/#/live`);
const escape = (page: Page) => page.keyboard.press('Escape');

async function edit(page: Page, server: Server) {
  await page.goto(`${server.url}/#/edit`);
  await pixelsAre(page);
}

async function halfway(page: Page) {
  await button(page, 'Play').first().click();
  await page.getByText(/Playing frame [23] of/).waitFor();
  await eventually(
    () => page.getByRole('progressbar').first().getAttribute('aria-valuenow'),
    (done) => Number(done) > 30 && Number(done) < 90,
    'the middle of a drive',
  );
}

async function abort(page: Page) {
  await escape(page);
  await phaseIs(page, 'ready');
}

const dialog = (name: string, open: (page: Page) => Promise<void>): View => ({
  name,
  async show(page) {
    await open(page);
    // A dialog gets its name after it appears.
    await page.locator('[role=dialog][aria-labelledby]').waitFor();
  },
  async leave(page) {
    await escape(page);
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
  },
});

/** A show of thirty robots whose first frame waits for GO. */
function showWithCue(): string {
  const show = JSON.parse(smallShow(30)) as { frames: { id?: string }[] };
  const [first] = show.frames;
  if (first) first.id = 'first';
  return JSON.stringify({ ...show, lightbots: 2, cues: [{ name: 'Curtain', frame: 'first' }] });
}

/** The same show with a marker, a section and layers, which the timeline shows. */
function showWithMarks(): string {
  const show = JSON.parse(showWithCue()) as object;
  return JSON.stringify({
    ...show,
    markers: [{ name: 'Drum', at_s: 1 }],
    sections: [{ name: 'Verse', from_s: 0, to_s: 3 }],
    layers: [
      { kind: 'rainbow', frames: ['first', 'first'], phase: 'picture' },
      { kind: 'pulse', from_s: 1, to_s: 4 },
    ],
  });
}

const liveViews: View[] = [
  {
    name: 'live-ready',
    async show(page, server) {
      await goLive(page, server);
      await openShow(page, 'heart');
      await phaseIs(page, 'ready');
    },
  },
  {
    name: 'live-playing',
    async show(page) {
      await halfway(page);
    },
  },
  {
    name: 'live-paused',
    async show(page) {
      await button(page, 'Pause').click();
      await phaseIs(page, 'paused');
    },
    leave: abort,
  },
  {
    name: 'live-waiting-for-go',
    async show(page) {
      await uploadText(page, 'curtain.json', showWithCue());
      await button(page, 'Play').click();
      await page.getByTestId('go-note').waitFor();
    },
    async leave(page) {
      await abort(page);
      await openShow(page, 'heart');
    },
  },
  { name: 'live-cues', show: (page) => page.getByRole('tab', { name: 'Cues' }).click() },
  dialog('go-to-frame', (page) => button(page, 'Go to frame 1').click()),
  { name: 'live-light', show: (page) => page.getByRole('tab', { name: 'Light' }).click() },
  { name: 'live-show', show: (page) => page.getByRole('tab', { name: 'Show' }).click() },
  {
    name: 'live-log',
    show: (page) => page.getByRole('tab', { name: 'Log' }).click(),
    leave: (page) => page.getByRole('tab', { name: /^Robots/ }).click(),
  },
  dialog('checklist', (page) => page.keyboard.press('c')),
  dialog('robot', (page) =>
    page
      .getByRole('button', { name: /^Details of robot/ })
      .first()
      .click(),
  ),
  {
    name: 'live-all-columns',
    show: (page) => button(page, 'Details').click(),
    leave: (page) => button(page, 'Details').click(),
  },
  dialog('library', (page) => page.getByTestId('open-library').click()),
  dialog('settings', (page) => button(page, 'Settings').click()),
  dialog('settings-broker', async (page) => {
    await button(page, 'Settings').click();
    await page.getByText('External', { exact: true }).click();
  }),
  dialog('keyboard', (page) => page.keyboard.press('Shift+?')),
  {
    name: 'error',
    async show(page) {
      await uploadText(page, 'broken.json', '{"lightbots": 1, "frames": [', false);
      await page
        .getByRole('alert')
        .getByText(/broken\.json/)
        .waitFor();
    },
    async leave(page) {
      const told = page.getByRole('alert').filter({ hasText: 'broken.json' });
      await told.getByRole('button', { name: 'Close' }).click();
      await told.waitFor({ state: 'detached' });
    },
  },
];

/** Two robots that fall silent while the page is open; `leave` removes them with Forget. */
const deadRobots: View = {
  name: 'live-dead-robots',
  async show(page, server) {
    await goLive(page, server);
    await openShow(page, 'heart');
    const silent = page.locator('tr[data-presence=gone], tr[data-presence=stale]');
    const rows = page.locator('tbody tr');
    const before = await rows.count();
    const end = await startRobots(server, 2);
    await countIs(rows, before + 2);
    await end();
    await countIs(silent, 2);
    await button(page, 'Details').click();
    await silent.first().scrollIntoViewIfNeeded();
  },
  async leave(page) {
    const silent = page.locator('tr[data-presence=gone], tr[data-presence=stale]');
    for (let left = 2; left > 0; left--) {
      await silent
        .first()
        .getByRole('button', { name: /^Details of/ })
        .click();
      await page.getByRole('dialog').getByRole('button', { name: 'Forget' }).click();
      await countIs(silent, left - 1);
    }
    await button(page, 'Details').click();
  },
};

/** The checklist when robots are missing. */
const missing: View = {
  name: 'checklist-missing',
  async show(page, server) {
    await goLive(page, server);
    await uploadText(page, 'many.json', smallShow(32));
    await page.keyboard.press('c');
    await page
      .getByRole('dialog')
      .getByText(/missing/)
      .waitFor();
  },
  async leave(page) {
    await escape(page);
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
    // The notice of the upload covers a corner of the views that follow.
    await page
      .getByText(/^Imported and opened/)
      .first()
      .waitFor({ state: 'detached' });
  },
};

/** The dialog after another person changed the show: every save of this page is answered with status 412. */
const conflict: View = {
  name: 'edit-conflict',
  async show(page, server) {
    await uploadText(page, 'shared.json', smallShow(12));
    await edit(page, server);
    await pixelsAre(page, 12);
    await page.route('**/api/shows/*', (route) =>
      route.request().method() === 'PUT'
        ? route.fulfill({ status: 412, json: { error: 'Another person was faster.' } })
        : route.continue(),
    );
    await button(page, 'All').click();
    await button(page, 'Colour pink #ff2f92').click();
    await page.getByRole('dialog', { name: /changed on another screen/ }).waitFor();
  },
  async leave(page) {
    await page.unroute('**/api/shows/*');
    await page.getByRole('button', { name: /^Use theirs/ }).click();
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
  },
};

const editViews: View[] = [
  {
    name: 'edit-nothing-chosen',
    async show(page, server) {
      await openShow(page, 'heart');
      await edit(page, server);
    },
  },
  {
    name: 'edit-chosen',
    async show(page) {
      await button(page, /^2/).first().click();
      await button(page, 'All').click();
    },
  },
  {
    name: 'edit-menu',
    async show(page) {
      await page.keyboard.press('Shift+F10');
      await page.getByRole('menuitem', { name: 'Select same colour' }).waitFor();
    },
    leave: escape,
  },
  {
    name: 'edit-make-words',
    async show(page) {
      await page.keyboard.press('t');
      await page.keyboard.type('HI');
      await page.getByTestId('verdict').getByText('Readable').waitFor();
    },
  },
  {
    name: 'edit-drop',
    async show(page) {
      await hold(page, { files: { 'cat.svg': '<svg/>' } });
      await page.getByTestId('veil').waitFor();
    },
    async leave(page) {
      await page.dispatchEvent('body', 'dragleave', {
        dataTransfer: await page.evaluateHandle(() => {
          const transfer = new DataTransfer();
          transfer.items.add(new File([], 'cat.svg'));
          return transfer;
        }),
      });
      await page.getByTestId('veil').waitFor({ state: 'detached' });
    },
  },
  {
    name: 'edit-make-shape',
    async show(page) {
      await page.getByText('Shape', { exact: true }).click();
      await button(page, 'Star').click();
      await page
        .getByTestId('verdict')
        .getByText(/^12 robots|^30 robots/)
        .waitFor();
    },
  },
  {
    name: 'edit-draw',
    async show(page) {
      await button(page, 'Curve').click();
      for (let i = 0; i < 3; i++) await button(page, 'Add a point').click();
      await page.getByText('Point 3 of 3').waitFor();
    },
    leave: (page) => button(page, 'Cancel').click(),
  },
  { name: 'edit-frame', show: (page) => page.getByRole('tab', { name: 'Frame' }).click() },
  {
    name: 'edit-show',
    show: (page) => page.getByRole('tab', { name: /^Show/ }).click(),
    leave: (page) => page.getByRole('tab', { name: 'Pixels' }).click(),
  },
  {
    name: 'edit-ways',
    async show(page) {
      await page.keyboard.press('w');
      await page.keyboard.press('n');
    },
    leave: (page) => page.keyboard.press('n'),
  },
  {
    name: 'edit-scrubbing',
    async show(page) {
      await button(page, /^2/).first().click();
      await page.getByRole('slider', { name: 'Moment of the show' }).focus();
      for (let i = 0; i < 90; i++) await page.keyboard.press('ArrowLeft');
    },
    leave: (page) => page.keyboard.press('w'),
  },
  {
    name: 'edit-light-presets',
    show: (page) => page.getByRole('tab', { name: 'Light' }).click(),
  },
  {
    name: 'edit-light',
    async show(page) {
      await page
        .getByRole('list', { name: 'Presets of light' })
        .getByRole('button', { name: 'Rainbow' })
        .click();
      await page.getByRole('region', { name: 'Layer Rainbow' }).waitFor();
    },
    async leave(page) {
      await button(page, 'Delete Rainbow').click();
      await page.getByRole('tab', { name: 'Pixels' }).click();
    },
  },
  {
    name: 'edit-timeline',
    async show(page, server) {
      await uploadText(page, 'marks.json', showWithMarks());
      await edit(page, server);
      await page.keyboard.press('l');
      await page.getByRole('option', { name: /^Frame 2 Two: drive/ }).click();
      await page.getByRole('listbox', { name: 'Markers' }).focus();
    },
    leave: (page) => button(page, 'Timeline (L)').click(),
  },
  {
    name: 'edit-too-close',
    async show(page, server) {
      await uploadText(page, 'crowded.json', smallShow(24).replaceAll('0.12', '0.05'));
      await edit(page, server);
      await button(page, 'All').click();
      await button(page, 'Align middles').click();
      await page.getByText(/too close to each other/).waitFor();
    },
  },
];

/** Views of a server without robots, in a page that has not shown the tour. */
export const FIRST_VIEWS: readonly View[] = [
  {
    name: 'live-empty',
    async show(page) {
      await page.getByText('No robots yet').waitFor();
    },
  },
  {
    name: 'edit-tour',
    async show(page) {
      await beginEmpty(page);
      await page.getByRole('region', { name: 'First steps' }).waitFor();
    },
  },
];

/** Every view of a server with robots; each begins where the one before it ended. */
export const VIEWS: readonly View[] = [...liveViews, deadRobots, missing, ...editViews, conflict];
