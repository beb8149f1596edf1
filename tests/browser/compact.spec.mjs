// Compact figures at a height given by the host: picture, main buttons and readouts, plus a drawer.

import { serve } from "./server.mjs";
import { expect, expectAccessible, figures, middle, settled, SLIDER, test, told } from "./fixtures.mjs";
import { script } from "./places.mjs";

test.use({ shared: true });

/** Sizes in pixels: a slide of reveal.js, and little more than a thumbnail. */
const SIZES = [[960, 700], [400, 300]];
/** Minimum size of the picture relative to the smaller side of its host. */
const LEAST = 0.55;

/** Serves a page with a figure at the given size; `more` are further attributes. */
async function host(site, name, [width, height], more = "", around = "") {
  const page = `<!doctype html><html lang="en"><meta charset="utf-8"><title>A slide</title>
    <style>body { margin: 0 } main { width: ${width}px; height: ${height}px; ${around} } epipole-figure { height: 100% }</style>
    <script type="module" src="${site}/elements/${script}"></script>
    <main><h1 style="position: absolute; clip-path: inset(50%)">Slide</h1><epipole-figure compact name="${name}"${more}></epipole-figure></main>`;
  return serve({ mounts: { "": () => page }, policy: false });
}

async function opened(page, site, name, size, more, around) {
  const other = await host(site, name, size, more, around);
  await page.goto(other.origin);
  const figure = page.locator("epipole-figure");
  await expect(figure).toHaveAttribute("data-ready", "");
  await settled(figure);
  return { figure, close: other.close };
}

/** Boxes of the parts, pixels relative to the figure's corner. */
function places(figure) {
  return figure.evaluate((element) => {
    element.flush();
    const home = element.getBoundingClientRect();
    const of = (selector) => {
      const box = element.shadowRoot.querySelector(selector).getBoundingClientRect();
      return { left: box.left - home.left, top: box.top - home.top, width: box.width, height: box.height };
    };
    const bar = element.shadowRoot.querySelector(".bar");
    return {
      home: { width: home.width, height: home.height },
      picture: of(".sheet"),
      bar: of(".bar"),
      cut: bar.scrollHeight > bar.clientHeight + 1 || bar.scrollWidth > bar.clientWidth + 1,
    };
  });
}

for (const { name } of figures) {
  test(`${name} fits, and stays where it is`, async ({ page, site }) => {
    const { figure, close } = await opened(page, site, name, SIZES[0]);
    for (const size of SIZES) {
      const [width, height] = size;
      const resize = ([across, down]) => Object.assign(document.querySelector("main").style, { width: `${across}px`, height: `${down}px` });
      await page.evaluate(resize, size);
      await expect.poll(async () => (await places(figure)).home).toEqual({ width, height });
      // Layout that depends on the size takes effect with the next frames.
      await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done)))));
      const before = await places(figure);
      const { picture, bar } = before;
      for (const part of [picture, bar]) {
        expect(part.left).toBeGreaterThanOrEqual(0);
        expect(part.top).toBeGreaterThanOrEqual(0);
        expect(part.left + part.width).toBeLessThanOrEqual(width);
        expect(part.top + part.height).toBeLessThanOrEqual(height);
      }
      const apart = picture.left + picture.width <= bar.left + 0.5 || picture.top + picture.height <= bar.top + 0.5;
      expect(apart, JSON.stringify(before)).toBe(true);
      expect(Math.max(picture.width / width, picture.height / height)).toBeGreaterThan(LEAST);
      for (const button of await figure.locator(".bar button:visible").all()) await expect(button).toBeInViewport({ ratio: 1 });

      // Opening, changing and closing moves nothing.
      await figure.getByRole("button", { name: "More" }).click();
      expect(await places(figure)).toEqual(before);
      const slider = figure.locator(`.drawer .panel > .inputs ${SLIDER}`).first();
      for (const key of (await slider.count()) > 0 ? ["ArrowRight", "End", "Home"] : []) {
        await slider.press(key);
        const now = await places(figure);
        expect(now.picture.left + now.picture.width / 2).toBeCloseTo(picture.left + picture.width / 2, 0);
        expect(now.bar).toEqual(bar);
      }
      await figure.locator(".drawer button").first().focus();
      await page.keyboard.press("Escape");
      await expect(figure.locator(".drawer")).toBeHidden();
      await expect(figure.getByRole("button", { name: "More" })).toBeFocused();
      await page.keyboard.press("Escape");
      expect(await page.evaluate(() => document.activeElement.localName)).toBe("body");
    }
    await close();
  });
}

test("mouse, finger and keys move points on a slide that is scaled", async ({ browser, site }) => {
  const context = await browser.newContext({ viewport: { width: 700, height: 540 }, hasTouch: true });
  const page = await context.newPage();
  // Scaled by a transform, as slides are.
  const around = "transform: scale(0.7); transform-origin: 0 0;";
  const { figure, close } = await opened(page, site, "epipolar-click", [960, 700], "", around);
  const grip = figure.locator(".grip").first();
  const state = async () => (await told(figure)).state;
  const from = await middle(grip);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 30, from.y + 10, { steps: 4 });
  await page.mouse.up();
  const dragged = await state();
  expect(Object.keys(dragged).length).toBeGreaterThan(0);
  const now = await middle(grip);
  expect(Math.hypot(now.x - from.x - 30, now.y - from.y - 10)).toBeLessThan(2);

  await page.keyboard.press("ArrowLeft");
  const nudged = await state();
  expect(nudged).not.toEqual(dragged);

  const touch = await context.newCDPSession(page);
  const at = await middle(grip);
  const send = (type, points) => touch.send("Input.dispatchTouchEvent", { type, touchPoints: points });
  await send("touchStart", [{ x: at.x, y: at.y }]);
  for (let step = 1; step <= 5; step += 1) await send("touchMove", [{ x: at.x - 6 * step, y: at.y }]);
  await send("touchEnd", []);
  expect(await state()).not.toEqual(nudged);
  await close();
  await context.close();
});

test("Run is in sight and runs, and the numbers with it", async ({ page, site }) => {
  const { figure, close } = await opened(page, site, "ransac-race", [400, 300]);
  const drawn = async () => (await told(figure)).readouts;
  const before = await drawn();
  await figure.locator(".bar").getByRole("button", { name: "Step" }).click();
  expect(await drawn()).not.toEqual(before);
  await expect(figure.locator(".bar .readouts dd").first()).toBeVisible();
  await close();
});

test("compact comes and goes, as attribute and as property, also before the script", async ({ page, site }) => {
  const { figure, close } = await opened(page, site, "ransac-race", [960, 700]);
  expect(await figure.evaluate((element) => element.compact)).toBe(true);
  await figure.evaluate((element) => (element.compact = false));
  await expect(figure.locator(".bar")).toHaveCount(0);
  await expect(figure.locator(".panel > .inputs")).toBeVisible();
  await expect(figure.locator(".under").getByRole("button", { name: "Run" })).toBeVisible();
  await figure.evaluate((element) => element.setAttribute("compact", ""));
  await expect(figure.locator(".bar").getByRole("button", { name: "Run" })).toBeVisible();
  expect((await places(figure)).home.height).toBe(700);
  await page.evaluate(() => {
    const early = document.createElement("div");
    early.innerHTML = "<template><epipole-figure name='two-cameras'></epipole-figure></template>";
    const made = early.firstChild.content.firstChild;
    made.compact = true;
    document.querySelector("main").replaceChildren(made);
  });
  await expect(figure.locator(".bar")).toBeVisible();
  await close();
});

test("an open drawer is accessible", async ({ page, site }) => {
  const { figure, close } = await opened(page, site, "ransac-line", [960, 700]);
  await figure.getByRole("button", { name: "More" }).click();
  await expectAccessible(page);
  await close();
});

test("what is wrong is told over the picture, and moves nothing", async ({ page, site }) => {
  const { figure, close } = await opened(page, site, "ransac-race", [400, 300], ' outliers="lots"');
  await expect(figure.locator(".notice")).toContainText('"lots" is not a value of outliers');
  const before = await places(figure);
  await figure.evaluate((element) => element.apply({ points: "many" }));
  await expect(figure.locator(".notice")).toContainText('"many"');
  expect(await places(figure)).toEqual(before);
  await close();
});
