// Operating a figure before its first picture is prepared: page and figure stay responsive.

import { expect, figures, test } from "./fixtures.mjs";
import { loadBindings } from "./places.mjs";

const { Figure } = await loadBindings();
/** Figures whose first picture takes long. */
const slow = figures.filter(({ name }) => {
  const figure = new Figure(name);
  const more = figure.prepare();
  figure.free();
  return more;
});

/** Suppresses idle callbacks, in which figures prepare, except those with a timeout. */
function neverIdle() {
  const later = window.requestIdleCallback.bind(window);
  const waiting = (window.waiting = new Map());
  let number = 1e6;
  window.requestIdleCallback = (work, options) => {
    if (options) return later(work, options);
    waiting.set((number += 1), work);
    return number;
  };
  window.cancelIdleCallback = (id) => waiting.delete(id);
}

/**
 * Moves the first slider to its end, or the first handle by a step. Counts frames until the picture
 * is shown, and until the event.
 */
async function touched(element) {
  const root = element.shadowRoot;
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  const canvas = root.querySelector("canvas");
  const before = JSON.stringify(element.state);
  const wasShown = !canvas.hidden;
  let told;
  let frames = 0;
  element.addEventListener("epipole-change", () => (told ??= frames));
  element.dispatchEvent(new PointerEvent("pointerenter"));
  const slider = root.querySelector("input[type=range]");
  if (slider) slider.value = slider.max;
  slider?.dispatchEvent(new Event("input", { bubbles: true, composed: true }));
  if (!slider) root.querySelector(".grip").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight", bubbles: true }));
  while (canvas.hidden && frames < 1000) {
    await frame();
    frames += 1;
  }
  return { wasShown, frames, told, moved: JSON.stringify(element.state) !== before };
}

test("there are figures that prepare", () => {
  expect(slow.map(({ name }) => name)).toContain("epipolar-click");
});

for (const { name } of slow) {
  test(`${name} prepares its first picture in slices, and answers meanwhile`, async ({ page, open }) => {
    await page.addInitScript(neverIdle);
    const figure = await open(page, [name], { wait: false, query: { poster: 720 } });
    await expect(figure).toHaveAttribute("data-ready", "");
    const { wasShown, frames, told, moved } = await figure.evaluate(touched);
    expect(wasShown).toBe(false);
    expect(moved).toBe(true);
    // One slice per frame: prepared at once, the picture would be shown in the first or second.
    expect(frames).toBeGreaterThan(2);
    expect(frames).toBeLessThan(1000);
    expect(told).toBeLessThan(frames);
  });
}

test("whoever asks for the picture at once has it at once", async ({ page, open }) => {
  await page.addInitScript(neverIdle);
  const figure = await open(page, ["epipolar-click"], { wait: false, query: { poster: 720 } });
  await expect(figure).toHaveAttribute("data-ready", "");
  const hidden = () => figure.evaluate((element) => element.shadowRoot.querySelector("canvas").hidden);
  expect(await hidden()).toBe(true);
  await figure.evaluate((element) => element.flush());
  expect(await hidden()).toBe(false);
});

test("a figure that is gone waits for no idle moment, which would hold it", async ({ page, open }) => {
  await page.addInitScript(neverIdle);
  const figure = await open(page, ["epipolar-click"], { wait: false, query: { poster: 720 } });
  await expect(figure).toHaveAttribute("data-ready", "");
  const waiting = () => page.evaluate(() => window.waiting.size);
  await expect.poll(waiting).toBe(1);
  await figure.evaluate((element) => element.remove());
  await expect.poll(waiting).toBe(0);
});
