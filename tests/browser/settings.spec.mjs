// The reader's settings: their panel, what page and figures make of them, and how they are kept.

import { allReady, expect, expectAccessible, followed, listen, ready, test } from "./fixtures.mjs";
import { book } from "./places.mjs";
import { BOOK_POLICY, serve } from "./server.mjs";

test.skip(!book, "the book is not what is tested");

const KEY = "epipole-settings";
const stored = (page) => page.evaluate((key) => JSON.parse(localStorage.getItem(key)), KEY);
const given = (page, settings) => page.addInitScript(([key, text]) => localStorage.setItem(key, text), [KEY, JSON.stringify(settings)]);

/** Opens the panel. */
async function opened(page) {
  await page.locator(".settings-button").click();
  const panel = page.getByRole("dialog", { name: "Settings" });
  await expect(panel).toBeVisible();
  return panel;
}

/** Chooses a value of a setting. */
const choose = (panel, group, value) =>
  panel.getByRole("group", { name: group, exact: true }).getByRole("radio", { name: value, exact: true }).check();

test("keys open the panel, choose, and close it", async ({ page, library }) => {
  await page.goto(`${library}/rays.html`);
  const button = page.getByRole("button", { name: "Settings" });
  await expect(button).toHaveAttribute("aria-haspopup", "dialog");
  await expect(button).toHaveAttribute("aria-expanded", "false");
  await button.focus();
  await page.keyboard.press("Enter");
  const panel = page.getByRole("dialog", { name: "Settings" });
  await expect(panel).toBeVisible();
  await expect(button).toHaveAttribute("aria-expanded", "true");
  const inGroup = (name) => panel.getByRole("group", { name, exact: true }).getByRole("radio");
  await expect(inGroup("Colors").first()).toBeFocused();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await expect(page.locator("html")).toHaveAttribute("data-theme", "dark");
  for (const name of ["Contrast", "Text size", "Typeface", "Motion"]) {
    await page.keyboard.press("Tab");
    await expect(inGroup(name).first()).toBeFocused();
  }
  await page.keyboard.press("Tab");
  await expect(panel.getByRole("button", { name: "Reset" })).toBeFocused();
  await page.keyboard.press("Enter");
  await expect(page.locator("html")).not.toHaveAttribute("data-theme");
  await expect(inGroup("Colors").first()).toBeFocused();
  await page.keyboard.press("Escape");
  await expect(panel).toBeHidden();
  await expect(button).toBeFocused();
  await expect(button).toHaveAttribute("aria-expanded", "false");
  // The button closes it, too, and so does a click elsewhere.
  await button.click();
  await expect(panel).toBeVisible();
  await button.click();
  await expect(panel).toBeHidden();
  await opened(page);
  await page.locator("h1").click();
  await expect(panel).toBeHidden();
});

test("figures and page follow at once", async ({ page, library }) => {
  await page.emulateMedia({ colorScheme: "light" });
  await page.goto(`${library}/eight-point.html`);
  const figure = page.locator("epipole-figure").first();
  await ready(figure);
  const panel = await opened(page);
  const root = page.locator("html");
  const body = (property) => page.evaluate((name) => getComputedStyle(document.body)[name], property);
  // Two frames and a drawing, with room for a loaded machine.
  const soon = (took) => expect(took).toBeLessThan(1000);
  soon(await followed(figure, "dark", () => choose(panel, "Colors", "Dark")));
  expect(await body("backgroundColor")).toBe("rgb(22, 24, 28)");
  soon(await followed(figure, "high-contrast", () => choose(panel, "Contrast", "More")));
  expect(await body("backgroundColor")).toBe("rgb(0, 0, 0)");
  soon(await followed(figure, "light", () => panel.getByRole("button", { name: "Reset" }).click().then(() => choose(panel, "Colors", "Light"))));
  expect(await body("backgroundColor")).toBe("rgb(255, 255, 255)");

  const size = async (selector) => page.locator(selector).first().evaluate((element) => parseFloat(getComputedStyle(element).fontSize));
  const readout = () => figure.locator(".readouts dd, .readouts output, .readouts").first().evaluate((element) => parseFloat(getComputedStyle(element).fontSize));
  const [text, bar, inFigure] = [await size("article p"), await size(".contents"), await readout()];
  await choose(panel, "Text size", "150%");
  expect(await size("article p")).toBeCloseTo(1.5 * text, 3);
  expect(await size(".contents")).toBeCloseTo(1.5 * bar, 3);
  expect(await readout()).toBeCloseTo(1.5 * inFigure, 3);

  await choose(panel, "Typeface", "More legible");
  const paragraph = page.locator("article p").nth(1);
  const spacing = await paragraph.evaluate((element) => {
    const { fontSize, letterSpacing, wordSpacing, lineHeight, marginBottom } = getComputedStyle(element);
    return [letterSpacing, wordSpacing, lineHeight, marginBottom].map((length) => parseFloat(length) / parseFloat(fontSize));
  });
  [0.12, 0.16, 1.5, 2].forEach((least, index) => expect(spacing[index]).toBeGreaterThanOrEqual(least - 1e-3));
  expect(await stored(page)).toEqual({ theme: "light", text: "150", face: "legible" });
  await panel.getByRole("button", { name: "Reset" }).click();
  expect(await stored(page)).toBe(null);
  await expect(root).not.toHaveAttribute("data-face");
});

test("reduced motion stops glides and small pictures, as the system's does", async ({ page, library }) => {
  await page.setViewportSize({ width: 1400, height: 900 });
  await page.emulateMedia({ reducedMotion: "no-preference" });
  await page.goto(`${library}/eight-point.html`);
  const figure = page.locator("epipole-figure").first();
  await ready(figure);
  const panel = await opened(page);
  const glide = (count) =>
    figure.evaluate(async (element, value) => {
      const start = performance.now();
      await element.glide({ count: value }, { duration: 2000, scroll: false });
      return performance.now() - start;
    }, count);
  expect(await glide("40")).toBeGreaterThan(1900);
  await choose(panel, "Motion", "Reduced");
  expect(await glide("16")).toBeLessThan(1500);

  await page.goto(`${library}/connections.html`);
  const card = page.locator('.small[data-figure="four-poses"]');
  await card.scrollIntoViewIfNeeded();
  await card.hover();
  // Longer than the pointer must rest on a picture.
  await page.waitForTimeout(800);
  await expect(page.locator(".small epipole-figure")).toHaveCount(0);
  await choose(await opened(page), "Motion", "System");
  await page.keyboard.press("Escape");
  await card.focus();
  await expect(page.locator(".small epipole-figure")).toHaveCount(1);
});

test("settings are there before the first paint, without the page's script, and other tabs follow", async ({ page, library, context, complaints }) => {
  await page.emulateMedia({ colorScheme: "light" });
  await page.goto(`${library}/rays.html`);
  const panel = await opened(page);
  await choose(panel, "Colors", "Dark");
  await choose(panel, "Text size", "130%");

  const other = await context.newPage();
  listen(other, complaints);
  await other.emulateMedia({ colorScheme: "light" });
  await other.route(/assets[/](page|index)-.*js/, () => {});
  await other.goto(`${library}/rays.html`, { waitUntil: "commit" });
  // Elements are there before the style sheets, which the first paint waits for.
  await other.waitForFunction(() => performance.getEntriesByName("first-paint").length === 1);
  expect(await other.evaluate(() => getComputedStyle(document.body).backgroundColor)).toBe("rgb(22, 24, 28)");
  expect(await other.evaluate(() => getComputedStyle(document.documentElement).fontSize)).toBe("20.8px");
  await other.unroute(/assets[/](page|index)-.*js/);

  await other.goto(`${library}/eight-point.html`);
  const figure = other.locator("epipole-figure").first();
  await ready(figure);
  await expect(figure.locator(".root")).toHaveAttribute("data-theme", "dark");
  const others = await opened(other);
  await choose(panel, "Colors", "System");
  await expect(figure.locator(".root")).toHaveAttribute("data-theme", "light");
  await expect(others.getByRole("radio", { name: "System" }).first()).toBeChecked();
  await panel.getByRole("button", { name: "Reset" }).click();
  await expect(other.locator("html")).not.toHaveAttribute("data-text");
});

for (const text of ["dark", "[]", '{"theme":"sepia","text":150,"motion":["reduced"],"__proto__":{"face":"legible"}}', `{"theme":"${"x".repeat(100_000)}"}`]) {
  test(`stored rubbish is ignored: ${text.slice(0, 24)}`, async ({ page, library }) => {
    await page.addInitScript(([key, rubbish]) => localStorage.setItem(key, rubbish), [KEY, text]);
    await page.goto(`${library}/rays.html`);
    for (const name of ["theme", "text", "motion", "face", "contrast"]) {
      await expect(page.locator("html")).not.toHaveAttribute(`data-${name}`);
    }
    const panel = await opened(page);
    await expect(panel.getByRole("button", { name: "Reset" })).toBeDisabled();
    await choose(panel, "Colors", "Dark");
    expect(await stored(page)).toEqual({ theme: "dark" });
  });
}

const LOOKS = [
  { theme: "light" },
  { theme: "dark", text: "115" },
  { theme: "light", contrast: "more" },
  { theme: "dark", contrast: "more", face: "legible", text: "130" },
];

for (const settings of LOOKS) {
  test(`axe finds nothing wrong with ${JSON.stringify(settings)}, and nothing moves`, async ({ page, library }) => {
    await given(page, settings);
    await page.setViewportSize({ width: 1280, height: 720 });
    await page.goto(`${library}/eight-point.html`, { waitUntil: "networkidle" });
    const shifts = () =>
      page.evaluate(
        () =>
          new Promise((done) => {
            let sum = 0;
            new PerformanceObserver((list) => list.getEntries().forEach(({ value }) => (sum += value))).observe({ type: "layout-shift", buffered: true });
            setTimeout(() => done(sum), 300);
          }),
      );
    expect(await shifts()).toBeLessThanOrEqual(0.01);
    await allReady(page.locator("epipole-figure"));
    await page.evaluate(() => scrollTo(0, 0));
    await opened(page);
    await expectAccessible(page);
  });
}

for (const width of [390, 320]) {
  test(`a phone ${width} px wide has room for the panel and the largest text`, async ({ browser, complaints }) => {
    const server = await serve({ mounts: { course: book }, policy: BOOK_POLICY });
    const context = await browser.newContext({ viewport: { width, height: 640 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true });
    const page = await context.newPage();
    listen(page, complaints);
    await given(page, { text: "150", face: "legible" });
    for (const name of ["eight-point", "connections", "progress", "index"]) {
      await page.goto(`${server.origin}/course/${name}.html`);
      await expect(page.locator("article > section:not(.settled)")).toHaveCount(0);
      expect(await page.evaluate(() => document.documentElement.scrollWidth), name).toBe(width);
    }
    await page.locator(".settings-button").tap();
    const panel = page.getByRole("dialog", { name: "Settings" });
    const within = await panel.evaluate((element) => {
      const { left, right, top, bottom } = element.getBoundingClientRect();
      return left >= 0 && right <= innerWidth && top >= 0 && bottom <= innerHeight && element.scrollWidth <= element.clientWidth;
    });
    expect(within).toBe(true);
    const reset = panel.getByRole("button", { name: "Reset" });
    await reset.tap();
    await expect(page.locator("html")).not.toHaveAttribute("data-text");
    await context.close();
    await server.close();
  });
}
