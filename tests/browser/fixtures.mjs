// What every test gets: a server with pages and elements, and a page whose console is watched.

import AxeBuilder from "@axe-core/playwright";
import { test as base, expect } from "@playwright/test";
import { join } from "node:path";
import { figurePage, made, shareAnswers } from "./pages.mjs";
import { bindings, book, elements, here, loadBindings } from "./places.mjs";
import { serve } from "./server.mjs";

const module = await loadBindings();
/** Every figure of the module: `{name, title, help}`. */
export const figures = JSON.parse(module.figures());

/** What every figure is at first, by name. */
export const snapshots = figures.map(({ name }) => [name, JSON.parse(new module.Figure(name).snapshot(760))]);
/** The first figure of a kind. */
export const first = (kind) => snapshots.find(([, snapshot]) => kind(snapshot))?.[0];
/** A figure that answers at once, with a slider that is in front. */
export const plain = first(
  ({ controls, waiting }) => waiting === null && controls.some(({ kind, place }) => kind === "slider" && place === "first"),
);

const test = base.extend({
  /** Pages and elements of one origin, under the policy of the book. */
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

  /** The book as it is served: under a sub-path, under its own policy. */
  library: [
    async ({}, use) => {
      const server = await serve({ mounts: { course: book } });
      await use(`${server.origin}/course`);
      await server.close();
    },
    { scope: "worker" },
  ],

  /** Errors that a test expects: `complaints.length = 0` forgives them. */
  complaints: async ({}, use) => {
    const complaints = [];
    await use(complaints);
    expect(complaints, "errors in the console").toEqual([]);
  },

  page: async ({ page, complaints }, use) => {
    listen(page, complaints);
    await use(page);
  },

  /** Whether pages share what their figures compute, in tests that have something else in mind. */
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
        // Some figures compute for a while after their first frame.
        if (options.settle !== false) {
          await expect(found.first().locator("[aria-busy]")).toHaveCount(0);
          // The first picture is drawn between frames, on a busy page after those that were waited for.
          await expect(found.first().locator("canvas")).toBeVisible();
        }
      }
      return names.length === 1 ? found.first() : found;
    });
  },
});

/** What axe knows that looks at colors. */
const COLOR_RULES = ["color-contrast", "link-in-text-block"];

/** Expects that axe finds nothing wrong: with `colors`, looking at nothing but these. */
export async function expectAccessible(page, { colors = false } = {}) {
  // Not in a page of its own for each answer, which takes longer than the rules: there are no foreign frames here.
  const axe = new AxeBuilder({ page }).setLegacyMode(true);
  if (colors) axe.withRules(COLOR_RULES);
  const { violations } = await axe.analyze();
  expect(violations.map(({ id, nodes }) => [id, nodes.map(({ html }) => html)])).toEqual([]);
}

/** Collects what a page complains about. */
export function listen(page, complaints) {
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
}

/** The width that a picture is laid out for in some room, as `web/src/room.ts` has it. */
export function layoutWidth(room) {
  return room < 500 ? 360 : room < 860 ? 720 : 1088;
}

/** Waits until a figure has drawn its first frame. */
export async function ready(figure) {
  await figure.scrollIntoViewIfNeeded();
  await expect(figure).toHaveAttribute("data-ready", "");
  // A figure whose poster shows its state draws when somebody takes an interest, with the next frame; what it computes
  // begins with that, too.
  await figure.dispatchEvent("pointerenter");
  await figure.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** Waits for what the figures compute. What they wait for shows with their next frame, so that is drawn. */
export async function settled(some) {
  await some.evaluateAll((elements) => elements.forEach((element) => element.flush()));
  await expect(some.locator("[aria-busy]")).toHaveCount(0);
}

/**
 * Changes a page so that a figure is to wear a theme, and waits until it does: how long that took by the clock of the
 * page, milliseconds, with the change itself.
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

/** State, readouts and description of a figure, as its element tells them. */
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

/** Where a figure's first focusable handle is on the screen; nothing for one that has only controls. */
export async function gripOf(figure) {
  const grip = figure.locator(".grip").first();
  return (await grip.count()) > 0 ? { grip, ...(await middle(grip)) } : undefined;
}

/** A slider that is in front and does something now; the weights of a kernel that is given do not. */
export const SLIDER = "input[type=range]:not([aria-disabled=true]):visible";

/** Changes a figure by the keys, `times` over: its first slider, away from its end, or its first choice. */
export async function change(page, figure, times = 1) {
  const settings = [figure.locator(SLIDER), figure.locator("input[type=radio]:checked"), figure.locator("select:visible")];
  const counts = await Promise.all(settings.map((setting) => setting.count()));
  const setting = settings[counts.findIndex((count) => count > 0)].first();
  await setting.focus();
  const [key, goesAround] = await setting.evaluate(({ type, value, min, selectedIndex, length }) => {
    if (type === "select-one") return [selectedIndex < length - 1 ? "ArrowDown" : "ArrowUp", false];
    return [type === "radio" || value === min ? "ArrowRight" : "ArrowLeft", type === "radio"];
  });
  // After two presses a pair of radio buttons would be as it was, with nothing to tell.
  const presses = goesAround ? 1 : times;
  for (let press = 0; press < presses; press += 1) await page.keyboard.press(key);
}

/** The middle of an element on the screen. */
export async function middle(locator) {
  const box = await locator.boundingBox();
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

export { test, expect };
