// Fixtures of all tests: a server with pages and elements, and a page whose console is checked.

import { test as base, expect } from "@playwright/test";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { figurePage, made, shareAnswers } from "./pages.mjs";
import { bindings, book, elements, here, loadBindings } from "./places.mjs";
import { BOOK_POLICY, serve } from "./server.mjs";

const module = await loadBindings();
/** Every figure of the module: `{name, title, help}`. */
export const figures = JSON.parse(module.figures());

/** Initial snapshots of all figures, `[name, snapshot]`. */
export const snapshots = figures.map(({ name }) => [name, JSON.parse(new module.Figure(name).snapshot(760))]);
/** The first figure that satisfies a predicate. */
export const first = (kind) => snapshots.find(([, snapshot]) => kind(snapshot))?.[0];
/** A figure without long computation and with a slider that is not folded. */
export const plain = first(
  ({ controls, waiting }) => waiting === null && controls.some(({ kind, place }) => kind === "slider" && place === "first"),
);

const test = base.extend({
  /** Address of pages and elements on one origin, with the book's content security policy. */
  site: [
    async ({}, use) => {
      const server = await serve({
        mounts: {
          figures: figurePage,
          pages: join(here, "pages"),
          made,
          elements,
          bindings,
        },
      });
      await use(server.origin);
      await server.close();
    },
    { scope: "worker" },
  ],

  /**
   * Address of the book as published: under a sub-path, with its own policy. EPIPOLE_LIBRARY names
   * another server.
   */
  library: [
    async ({}, use) => {
      if (process.env.EPIPOLE_LIBRARY) return use(process.env.EPIPOLE_LIBRARY);
      const server = await serve({ mounts: { course: book }, policy: BOOK_POLICY });
      await use(`${server.origin}/course`);
      await server.close();
    },
    { scope: "worker" },
  ],

  /** Console errors. To expect some, clear it: `complaints.length = 0`. */
  complaints: async ({}, use) => {
    const complaints = [];
    await use(complaints);
    expect(complaints, "errors in the console").toEqual([]);
  },

  page: async ({ page, complaints }, use) => {
    listen(page, complaints);
    await use(page);
  },

  /** Whether pages share computed answers, for tests that do not test computing. */
  shared: [false, { option: true }],

  /** Opens a page with figures: `open(page, ["ransac-race outliers=0.4"], { theme: "dark" })`. */
  open: async ({ site, shared }, use) => {
    const sharing = new WeakSet();
    await use(async (page, names, options = {}) => {
      if (shared && !sharing.has(page)) await shareAnswers(page);
      sharing.add(page);
      const query = new URLSearchParams(names.map((name) => ["figure", name]));
      for (const [key, value] of Object.entries(options.query ?? {})) query.set(key, value);
      await page.goto(`${site}/figures?${query}${options.more ?? ""}`);
      const found = page.locator("epipole-figure");
      if (options.wait !== false) {
        await ready(found.first());
        // Some figures compute after their first frame.
        if (options.settle !== false) {
          await idle(found.first());
          // On a busy page, the first picture may be drawn later than the computation ends.
          await expect(found.first().locator("canvas")).toBeVisible();
        }
      }
      return names.length === 1 ? found.first() : found;
    });
  },
});

const axe = readFileSync(join(here, "node_modules/axe-core/axe.min.js"), "utf8");

/** Rules of axe that depend on colors. */
const COLOR_RULES = ["color-contrast", "link-in-text-block"];

/** Runs in the page: what axe finds wrong, `[rule, markup of the elements]`. */
async function violations([rules, within]) {
  // Besides violations, axe would describe every element that passes, which takes longer.
  const options = { resultTypes: ["violations"], ...(rules && { runOnly: { type: "rule", values: rules } }) };
  const { violations } = await window.axe.run(within ?? document, options);
  return violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)]);
}

/**
 * Expects no violations from axe, `within` a selector or anywhere; with `colors`, checks only the
 * rules about colors.
 */
export async function expectAccessible(page, { colors = false, within } = {}) {
  for (const frame of page.frames()) {
    if (!(await frame.evaluate(() => "axe" in window))) await frame.evaluate(axe);
  }
  expect(await page.evaluate(violations, [colors ? COLOR_RULES : undefined, within])).toEqual([]);
}

/** Collects console errors and exceptions of a page. */
export function listen(page, complaints) {
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
}

/** Layout width for some available width, as in `web/src/room.ts`. */
export function layoutWidth(room) {
  return room < 500 ? 360 : room < 860 ? 720 : 1088;
}

/** Limit of waits in the page, as that of `expect`, milliseconds. */
const LIMIT_MS = 15_000;

/** Brings each figure into view and interest. Runs in the page, to wait without round trips. */
async function firstFrames(some, limit) {
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  for (const element of [some].flat()) {
    const end = performance.now() + limit;
    do {
      if (performance.now() > end) throw new Error(`${element.getAttribute("name")} has no first frame`);
      element.scrollIntoViewIfNeeded();
      await frame();
    } while (element.getAttribute("data-ready") !== "");
    // A figure with a matching poster draws and computes only when the reader takes an interest, in
    // the next frame.
    element.dispatchEvent(new PointerEvent("pointerenter", { bubbles: true, cancelable: true, composed: true }));
    await frame();
    await frame();
  }
}

/** Waits until a figure has drawn its first frame. */
export async function ready(figure) {
  await figure.evaluate(firstFrames, LIMIT_MS);
}

/** Waits until each of the figures, one after the other, has drawn its first frame. */
export async function allReady(figures) {
  await figures.evaluateAll(firstFrames, LIMIT_MS);
}

/**
 * Waits until figures compute nothing; with `flush`, draws first. Looks in the page, as `expect`
 * looks again only after up to a second.
 */
export async function idle(some, { flush = false } = {}) {
  const busy = await some.evaluateAll(async (elements, [limit, flush]) => {
    if (flush) for (const element of elements) element.flush();
    const isBusy = (element) => [element, element.shadowRoot].some((root) => root?.querySelector("[aria-busy]"));
    const end = performance.now() + limit;
    while (elements.some(isBusy) && performance.now() < end) await new Promise((done) => setTimeout(done, 10));
    return elements.filter(isBusy).map((element) => element.getAttribute("name"));
  }, [LIMIT_MS, flush]);
  expect(busy, "figures that compute").toEqual([]);
}

/** Waits for computations. Draws first, as a computation starts with the next frame. */
export async function settled(some) {
  await idle(some, { flush: true });
}

/**
 * Applies a change that switches a figure's theme and waits until the figure has followed. Returns
 * the time from before the change, milliseconds by the page's clock.
 */
export async function followed(figure, theme, change) {
  const watch = await figure.evaluateHandle((element, wanted) => {
    const root = element.shadowRoot.querySelector(".root");
    const start = performance.now();
    const took = new Promise((done) => {
      const look = () => root.dataset.theme === wanted && done(performance.now() - start);
      new MutationObserver(look).observe(root, { attributes: true });
      look();
    });
    return { took };
  }, theme);
  await change();
  await expect(figure.locator(".root")).toHaveAttribute("data-theme", theme);
  return watch.evaluate(({ took }) => took);
}

/** State, readouts and description of a figure. */
export function told(figure) {
  return figure.evaluate((element) => {
    element.flush();
    const { state, readouts, description } = element;
    return { state, readouts, description };
  });
}

/** Keeps the details of a figure's events in `element.testHears`. */
export function hear(figure, ...types) {
  return figure.evaluate((element, names) => {
    element.testHears = [];
    for (const name of names) {
      element.addEventListener(name, (event) => element.testHears.push([name, event.detail]));
    }
  }, types);
}

export function heard(figure) {
  return figure.evaluate((element) => element.testHears);
}

/**
 * First focusable handle and its position on the screen; undefined for a figure without handles.
 */
export async function gripOf(figure) {
  const grip = figure.locator(".grip").first();
  return (await grip.count()) > 0 ? { grip, ...(await middle(grip)) } : undefined;
}

/** Sliders that are visible and enabled; those of a preset kernel are disabled. */
export const SLIDER = "input[type=range]:not([aria-disabled=true]):visible";

/** Changes a figure by `times` key presses on its first slider (away from its end) or choice. */
export async function change(page, figure, times = 1) {
  const settings = [figure.locator(SLIDER), figure.locator("input[type=radio]:checked"), figure.locator("select:visible")];
  const counts = await Promise.all(settings.map((setting) => setting.count()));
  const setting = settings[counts.findIndex((count) => count > 0)].first();
  await setting.focus();
  const [key, goesAround] = await setting.evaluate(({ type, value, min, selectedIndex, length }) => {
    if (type === "select-one") return [selectedIndex < length - 1 ? "ArrowDown" : "ArrowUp", false];
    return [type === "radio" || value === min ? "ArrowRight" : "ArrowLeft", type === "radio"];
  });
  // A second press would reset a pair of radio buttons.
  const presses = goesAround ? 1 : times;
  for (let press = 0; press < presses; press += 1) await page.keyboard.press(key);
}

/** Center of an element on the screen. */
export async function middle(locator) {
  const box = await locator.boundingBox();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

export { test, expect };
