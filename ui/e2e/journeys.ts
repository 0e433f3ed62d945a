import type { Locator, Page } from 'playwright-core';
import type { Phase } from '../src/api/types.gen';
import { focusByTab } from './hand';
import { eventually } from './harness';

/** A show of two frames of `count` pixels in rows, with air times of `air_s`; y is 0.2 m smaller in the second. */
export function smallShow(count: number, air_s = 0.3): string {
  const frame = (name: string, y: number) => ({
    name,
    air_time_s: air_s,
    pixels: Array.from({ length: count }, (_, id) => ({
      id,
      place: [Math.round((-0.55 + (id % 12) * 0.1) * 1e4) / 1e4, y + Math.floor(id / 12) * 0.12],
      color: '#ff8c00',
    })),
  });
  const frames = [frame('One', 1.1), frame('Two', 0.9)];
  return JSON.stringify({ lightbots: 1, name: '', stage: { width_m: 3, depth_m: 3 }, frames });
}

/** Begins an empty show and waits for the editor's stage. */
export async function beginEmpty(page: Page): Promise<void> {
  await button(page, 'New').click();
  await button(page, 'Empty show').click();
  await page.getByTestId('stage').waitFor();
}

/** What is dropped or pasted: contents of files by name, or a text. */
export interface Brought {
  files?: Record<string, string | Uint8Array>;
  text?: string;
}

/** Dispatches a drop, drag or paste with these files or this text. */
async function bring(page: Page, brought: Brought, act: 'drop' | 'dragenter' | 'paste') {
  const files = Object.entries(brought.files ?? {}).map(([name, content]) => ({
    name,
    bytes: [...Buffer.from(content)],
  }));
  const data = await page.evaluateHandle(
    ([all, text]) => {
      const transfer = new DataTransfer();
      const types: Record<string, string> = { svg: 'image/svg+xml', gif: 'image/gif' };
      for (const { name, bytes } of all) {
        const type = types[name.split('.').pop() ?? ''] ?? '';
        transfer.items.add(new File([new Uint8Array(bytes)], name, { type }));
      }
      if (text !== null) transfer.setData('text/plain', text);
      return transfer;
    },
    [files, brought.text ?? null] as const,
  );
  if (act === 'paste')
    await page.evaluate((transfer) => {
      const init = { clipboardData: transfer, bubbles: true, cancelable: true };
      (document.activeElement ?? document.body).dispatchEvent(new ClipboardEvent('paste', init));
    }, data);
  else await page.dispatchEvent('body', act, { dataTransfer: data });
}

/** Drops files or a text on the page. */
export const drop = (page: Page, brought: Brought) => bring(page, brought, 'drop');

/** Holds files or a text over the page. */
export const hold = (page: Page, brought: Brought) => bring(page, brought, 'dragenter');

/** Pastes files or a text where the focus is. */
export const paste = (page: Page, brought: Brought) => bring(page, brought, 'paste');

/** Drops a file on the page; if `good`, waits for the notice that it was imported and opened. */
export async function uploadText(
  page: Page,
  name: string,
  text: string,
  good = true,
): Promise<void> {
  const data = await page.evaluateHandle(
    ([file, content]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([content], file, { type: 'application/json' }));
      return transfer;
    },
    [name, text] as const,
  );
  await page.dispatchEvent('body', 'drop', { dataTransfer: data });
  if (good)
    await page
      .getByText(/^Imported and opened/)
      .first()
      .waitFor();
}

/** Opens a show of the library with the dialog. */
export async function openShow(page: Page, name: string): Promise<void> {
  await page.getByTestId('open-library').click();
  const list = page.getByRole('list', { name: 'Shows in the library' });
  await list
    .getByRole('button', { name: new RegExp(`^${name}\\b`) })
    .first()
    .click();
  await page.getByTestId('open-library').getByText(name, { exact: true }).waitFor();
  await page.getByRole('dialog').waitFor({ state: 'hidden' });
}

/** A button by its whole name. */
export const button = (page: Page, name: string | RegExp) =>
  page.getByRole('button', { name, exact: true });

/** Waits until the run is in phase `wanted`. */
export const phaseIs = (page: Page, wanted: Phase) =>
  eventually(
    () => page.getByTestId('phase').getAttribute('data-phase'),
    (now) => now === wanted,
    `the phase is ${wanted}`,
  );

/** Waits until exactly `wanted` elements match. */
export const countIs = (things: Locator, wanted: number) =>
  eventually(
    () => things.count(),
    (count) => count === wanted,
    `there are ${wanted} of ${things}`,
  );

/** Measured places of the robots with a known place, from their list in the page, stage metres. */
export async function robotPlaces(page: Page): Promise<[number, number][]> {
  const lines = await page.getByTestId('robots').locator('li').allTextContents();
  return lines.flatMap((line) => {
    const found = /at (-?[\d.]+), (-?[\d.]+) metres/.exec(line);
    return found ? [[Number(found[1]), Number(found[2])] as [number, number]] : [];
  });
}

export interface Pixel {
  text: string;
  x: number;
  y: number;
  color: string;
  chosen: boolean;
}

/** The pixels of the frame on the stage, from their list in the page; places in stage metres. */
export const pixels = (page: Page): Promise<Pixel[]> =>
  page
    .getByTestId('pixels')
    .locator('[role=option]')
    .evaluateAll((options) =>
      options.map((o) => ({
        text: o.textContent ?? '',
        x: Number(o.getAttribute('data-x')),
        y: Number(o.getAttribute('data-y')),
        color: o.getAttribute('data-color') ?? '',
        chosen: o.getAttribute('aria-selected') === 'true',
      })),
    );

/** Waits until the frame has `wanted` pixels; without a number, until it has any. */
export const pixelsAre = (page: Page, wanted?: number) =>
  eventually(
    () => pixels(page),
    ({ length }) => (wanted === undefined ? length > 0 : length === wanted),
    `there are ${wanted ?? 'some'} pixels`,
  );

/** Waits until the dialog or menu has the focus, which comes a little later than it is seen. */
export const hasKeys = (page: Page, role: 'dialog' | 'menu') =>
  eventually(
    () => page.evaluate((r) => !!document.activeElement?.closest(`[role=${r}]`), role),
    (has) => has,
    `the ${role} has the focus`,
  );

/** Waits until the stage stays at its place on the screen: while a page loads, panels still move it. */
export const stageStands = (page: Page) => {
  let before = '';
  return eventually(
    async () => JSON.stringify(await page.getByTestId('stage').boundingBox()),
    (box) => (box === before && box !== 'null') || ((before = box), false),
    'the stage keeps its place',
  );
};

/** Waits until exactly these pixels are chosen; `wanted` has their indices in the list, ascending. */
export const chosenAre = (page: Page, wanted: number[]) =>
  eventually(
    async () => (await pixels(page)).flatMap((p, id) => (p.chosen ? [id] : [])),
    (ids) => ids.join() === wanted.join(),
    `pixels ${wanted.join()} are chosen`,
  );

/** CSS pixels a metre while the whole of a square floor is shown. */
export const scaleOf = (box: { width: number; height: number }, side_m: number) =>
  Math.min(box.width - 68, box.height - 88) / side_m;

/** Where a place of a 3 × 3 m stage is on screen while the whole floor is shown, CSS pixels. */
export async function onScreen(
  page: Page,
  x: number,
  y: number,
): Promise<{ x: number; y: number }> {
  const box = await page.getByTestId('stage').boundingBox();
  if (!box) throw new Error('There is no stage.');
  const scale = scaleOf(box, 3);
  return { x: box.x + box.width / 2 + x * scale, y: box.y + (box.height + 20) / 2 - y * scale };
}

export async function drag(
  page: Page,
  from: [number, number],
  to: [number, number],
): Promise<void> {
  const [a, b] = [await onScreen(page, ...from), await onScreen(page, ...to)];
  await page.mouse.move(a.x, a.y);
  await page.mouse.down();
  await page.mouse.move((a.x + b.x) / 2, (a.y + b.y) / 2, { steps: 4 });
  await page.mouse.move(b.x, b.y, { steps: 4 });
  await page.mouse.up();
}

/** Waits until all changes are saved in the library. */
export const saved = (page: Page) => page.locator('[data-testid=save][data-save=saved]').waitFor();

/** A library document as it is on the server. */
export const stored = (
  page: Page,
  name: string,
): Promise<{ frames: StoredFrame[]; name: string; stage: StoredStage }> =>
  page.evaluate(async (n) => (await fetch(`/api/shows/${encodeURIComponent(n)}`)).json(), name);

export interface StoredStage {
  width_m: number;
  obstacles?: unknown[];
  robot?: Record<string, number>;
}

export interface StoredFrame {
  name: string;
  air_time_s: number;
  identity?: string;
  pixels: { id: number; place: [number, number]; color: string; robot?: string; group?: string }[];
}

/** Presses Tab until the first control of this role and name has the focus. */
export const tabTo = (page: Page, role: string, name: string) =>
  focusByTab(page, page.getByRole(role as 'button', { name, exact: true }).first());

/** Begins an empty show for 30 robots; answers its name in the library. */
export async function beginShow(page: Page): Promise<string> {
  await beginEmpty(page);
  await pixelsAre(page, 30);
  const title = page.getByTestId('open-library').getByText(/^Untitled/);
  await title.waitFor();
  return (await title.textContent()) ?? '';
}

/** Makes the frame on the stage from a shape. */
export async function makeShape(page: Page, shape: string): Promise<void> {
  await button(page, 'Make…').click();
  await page.getByText('Shape', { exact: true }).click();
  await button(page, shape).click();
  await useMade(page);
}

/** Makes the frame on the stage from words. */
export async function makeWords(page: Page, words: string): Promise<void> {
  await button(page, 'Make…').click();
  await page.getByRole('textbox', { name: 'Words' }).fill(words);
  await useMade(page);
}

/** Uses what the Make panel shows; the panel closes. */
export async function useMade(page: Page): Promise<void> {
  await button(page, 'Use').click();
  await button(page, 'Change…').waitFor();
}
