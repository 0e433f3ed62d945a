import type { Page } from 'playwright-core';

/** Notes the moment of every frame in which the stage, or the audience view, was drawn. */
export function noteDraws() {
  const drawn: number[] = [];
  Object.assign(globalThis, { drawn });
  const prototype = CanvasRenderingContext2D.prototype;
  const note = (name: 'setTransform' | 'putImageData', around: string) => {
    const draw = prototype[name] as (...a: unknown[]) => void;
    prototype[name] = function (this: CanvasRenderingContext2D, ...more: unknown[]) {
      const now = Number(document.timeline.currentTime);
      if (now !== drawn[drawn.length - 1] && this.canvas.closest(around)) drawn.push(now);
      draw.apply(this, more);
    } as never;
  };
  note('setTransform', 'section');
  note('putImageData', '[data-viewpoint]');
}

/** Frames a second, gaps between frames, and work of the main thread. */
export interface Measured {
  fps: number;
  /** Gap between two frames that 5 % of the gaps exceed; null: there were no gaps to measure. */
  late_ms: number | null;
  /** Work of the main thread for each frame. */
  busy_ms: number;
}

/** From the moments of frames, milliseconds, within a span, and the work of the main thread in that span. */
function measured(moments: readonly number[], span_ms: number, busy_ms: number): Measured {
  const gaps = moments.slice(1).map((at, i) => at - (moments[i] ?? at));
  const sorted = gaps.sort((a, b) => a - b);
  return {
    fps: (moments.length / span_ms) * 1000,
    late_ms: sorted[Math.floor(sorted.length * 0.95)] ?? null,
    busy_ms: busy_ms / Math.max(1, moments.length),
  };
}

/** Processor time of the page's main thread during `work`, milliseconds; other programs do not count. */
async function busyDuring<T>(page: Page, work: () => Promise<T>): Promise<[T, number]> {
  const client = await page.context().newCDPSession(page);
  await client.send('Performance.enable', { timeDomain: 'threadTicks' });
  const busy_s = async () =>
    (await client.send('Performance.getMetrics')).metrics.find((m) => m.name === 'TaskDuration')
      ?.value ?? 0;
  const before_s = await busy_s();
  const done = await work();
  const busy_ms = ((await busy_s()) - before_s) * 1000;
  await client.detach();
  return [done, busy_ms];
}

/** Measures the frames in which the page drew the stage, for `lasts_ms`; `noteDraws` must run in the page. */
export async function measure(page: Page, lasts_ms = 6000): Promise<Measured> {
  const [gaps, busy_ms] = await busyDuring(page, () =>
    page.evaluate(async (span_ms) => {
      const { drawn } = globalThis as unknown as { drawn: number[] };
      drawn.length = 0;
      const began = performance.now();
      await new Promise((resolve) => setTimeout(resolve, span_ms));
      return { moments: [...drawn], span_ms: performance.now() - began };
    }, lasts_ms),
  );
  return measured(gaps.moments, gaps.span_ms, busy_ms);
}

interface TraceEvent {
  name: string;
  /** Microseconds. */
  ts: number;
}

/**
 * Measures the frames that the browser put on the screen, for a page in which nothing else moves. Scrolling is drawn
 * without the page's main thread, so that the page cannot count its frames.
 */
export async function measureShown(page: Page, lasts_ms = 6000): Promise<Measured> {
  const browser = page.context().browser();
  if (!browser) throw new Error('There is no browser.');
  await browser.startTracing(page, { categories: ['viz'] });
  const began = performance.now();
  const [span_ms, busy_ms] = await busyDuring(page, async () => {
    await page.waitForTimeout(lasts_ms);
    return performance.now() - began;
  });
  const trace = JSON.parse((await browser.stopTracing()).toString()) as {
    traceEvents: TraceEvent[];
  };
  const shown = trace.traceEvents.filter(({ name }) => name === 'DirectRenderer::DrawFrame');
  const moments = shown.map(({ ts }) => ts / 1000).sort((a, b) => a - b);
  return measured(moments, span_ms, busy_ms);
}
