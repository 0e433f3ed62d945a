import type { Browser, CDPSession } from 'playwright-core';
import { eventually } from './harness';

/** A tab behind another tab of its window, as operators leave them. Pages of Playwright always count as seen. */
export interface HiddenTab {
  /** The value of a JavaScript expression in the page. */
  ask(expression: string): Promise<unknown>;
}

/** Opens `count` hidden tabs with an address, and waits until each contains `text`. */
export async function openHiddenTabs(
  browser: Browser,
  url: string,
  count: number,
  text: string,
): Promise<HiddenTab[]> {
  const client = await browser.newBrowserCDPSession();
  await client.send('Target.createTarget', { url: 'about:blank' });
  const tabs: HiddenTab[] = [];
  for (let i = 0; i < count; i++) {
    const options = { url, newWindow: false, background: true };
    const { targetId } = await client.send('Target.createTarget', options);
    const { sessionId } = await client.send('Target.attachToTarget', { targetId, flatten: false });
    tabs.push(hiddenTab(client, sessionId));
  }
  const state = `document.visibilityState + document.body.textContent.includes(${JSON.stringify(text)})`;
  for (const tab of tabs)
    await eventually(
      () => tab.ask(state),
      (it) => it === 'hiddentrue',
      `a hidden tab shows '${text}'`,
    );
  return tabs;
}

function hiddenTab(client: CDPSession, sessionId: string): HiddenTab {
  let last = 0;
  return {
    ask(expression) {
      const id = ++last;
      return new Promise((resolve) => {
        const read = (event: { sessionId: string; message: string }) => {
          const said = JSON.parse(event.message) as {
            id?: number;
            result?: { result?: { value?: unknown } };
          };
          if (event.sessionId !== sessionId || said.id !== id) return;
          client.off('Target.receivedMessageFromTarget', read);
          resolve(said.result?.result?.value);
        };
        client.on('Target.receivedMessageFromTarget', read);
        const params = { expression, returnByValue: true };
        const message = JSON.stringify({ id, method: 'Runtime.evaluate', params });
        void client.send('Target.sendMessageToTarget', { sessionId, message });
      });
    },
  };
}
