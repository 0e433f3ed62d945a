import type { Locator, Page } from 'playwright-core';

/** Device with which a person operates the screen. */
export type Means = 'mouse' | 'touch' | 'keyboard';

/** Operates a page with one device only. */
export interface Hand {
  /** Presses a control. */
  press(thing: Locator): Promise<void>;
  /** Presses the first visible button of that name. */
  push(name: string | RegExp): Promise<void>;
  /** Types into a field. */
  type(field: Locator, text: string): Promise<void>;
}

/** Presses of Tab after which a control counts as out of reach; more than the controls of any page. */
const TABS_MAX = 200;

export function createHand(page: Page, means: Means): Hand {
  const press = async (thing: Locator) => {
    await thing.waitFor();
    if (means === 'mouse') return thing.click();
    if (means === 'touch') return thing.tap();
    await focusByTab(page, thing);
    // A switch reacts only to the space bar.
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

/** Presses Tab until a control has the focus; throws after `TABS_MAX` presses. */
export async function focusByTab(page: Page, thing: Locator) {
  for (let i = 0; i < TABS_MAX; i++) {
    if (await thing.evaluate((element) => element === document.activeElement)) return;
    await page.keyboard.press('Tab');
  }
  throw new Error(`Tab never came to ${thing}.`);
}
