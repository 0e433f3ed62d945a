import type { Locator, Page } from 'playwright-core';

/** How a person operates the screen. */
export type Means = 'mouse' | 'touch' | 'keyboard';

/** Operates a page by one means alone. */
export interface Hand {
  /** Presses a control. */
  press(thing: Locator): Promise<void>;
  /** Presses the first visible button of that name. */
  push(name: string | RegExp): Promise<void>;
  /** Types into a field. */
  type(field: Locator, text: string): Promise<void>;
}

/** More controls than any page has. */
const TABS_MAX = 200;

export function createHand(page: Page, means: Means): Hand {
  const press = async (thing: Locator) => {
    await thing.waitFor();
    if (means === 'mouse') return thing.click();
    if (means === 'touch') return thing.tap();
    await focusByTab(page, thing);
    // A switch knows only the blank.
    const isSwitch = (await thing.getAttribute('role')) === 'switch';
    await page.keyboard.press(isSwitch ? 'Space' : 'Enter');
  };
  return {
    press,
    push: (name) => press(page.getByRole('button', { name }).filter({ visible: true }).first()),
    async type(field, text) {
      if (means !== 'keyboard') return field.fill(text);
      await focusByTab(page, field);
      await page.keyboard.type(text);
    },
  };
}

/** Presses Tab until a control has the focus. */
export async function focusByTab(page: Page, thing: Locator) {
  for (let i = 0; i < TABS_MAX; i++) {
    if (await thing.evaluate((element) => element === document.activeElement)) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`Tab never came to ${thing}.`);
}
