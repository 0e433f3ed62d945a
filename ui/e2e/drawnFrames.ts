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

/** Notes, in place of drawn stages, the moment of every frame in which the timeline was scrolled or its last block moved. */
export function noteTimeline() {
  const moved: number[] = [];
  Object.assign(globalThis, { drawn: moved });
  const scroller = document.querySelector('[data-testid=timeline]');
  let before = '';
  const look = () => {
    requestAnimationFrame(look);
    const blocks = scroller?.querySelectorAll<HTMLElement>('[data-frame]');
    const now = `${scroller?.scrollLeft} ${blocks?.item(blocks.length - 1).style.left}`;
    if (now !== before) moved.push(Number(document.timeline.currentTime));
    before = now;
  };
  look();
}

/** Frames a second with the stage drawn, the gap that one frame in twenty exceeds, and main-thread work a frame. */
export async function measure(page: Page, lasts_ms = 6000) {
  const client = await page.context().newCDPSession(page);
  // Its own time on a core: what else the machine does is not its work.
  await client.send('Performance.enable', { timeDomain: 'threadTicks' });
  const busy_s = async () =>
    (await client.send('Performance.getMetrics')).metrics.find((m) => m.name === 'TaskDuration')
      ?.value ?? 0;
  const before_s = await busy_s();
  const gaps = await page.evaluate(async (span_ms) => {
    const { drawn } = globalThis as unknown as { drawn: number[] };
    drawn.length = 0;
    const began = performance.now();
    await new Promise((resolve) => setTimeout(resolve, span_ms));
    return {
      count: drawn.length,
      span_ms: performance.now() - began,
      all: drawn.slice(1).map((at, i) => at - (drawn[i] ?? at)),
    };
  }, lasts_ms);
  const busy_ms = ((await busy_s()) - before_s) * 1000;
  await client.detach();
  const sorted = gaps.all.sort((a, b) => a - b);
  return {
    fps: (gaps.count / gaps.span_ms) * 1000,
    late_ms: sorted[Math.floor(sorted.length * 0.95)] ?? null,
    busy_ms: busy_ms / Math.max(1, gaps.count),
  };
}
