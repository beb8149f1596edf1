// Every page of the book, served under a sub-path with its own strict content security policy.

import { readdirSync } from "node:fs";
import { allReady, expect, expectAccessible, listen, test } from "./fixtures.mjs";
import { book } from "./places.mjs";
import { kept, leaving, listenIn } from "./privacy.mjs";

// A figure's own page, and all pages of the book.
const pages = book ? ["figures/ransac-race.html", ...readdirSync(book)].filter((name) => name.endsWith(".html") && name !== "404.html") : [];

/** Starts every figure of a page. */
async function wake(page) {
  const figures = page.locator("epipole-figure");
  await allReady(figures);
  return figures;
}

for (const name of pages) {
  test.describe(name, () => {
    test("its figures come to life, and axe finds nothing wrong, light or dark", async ({ page, library }) => {
      const requests = listenIn(page.context());
      await page.emulateMedia({ colorScheme: "light" });
      await page.goto(`${library}/${name}`);
      await expect(page.locator("h1")).toHaveCount(1);
      const figures = await wake(page);
      for (const notice of await figures.locator(".notice").all()) await expect(notice).toBeHidden();
      await test.step("the console is silent, and nothing is asked of others or kept", async () => {
        await page.waitForLoadState("networkidle");
        expect(requests.length).toBeGreaterThan(3);
        expect(leaving(requests, new URL(library).origin)).toEqual([]);
        const { keys, besides } = await kept(page);
        // Waking the figures may stay at a heading for long enough.
        expect(keys.filter((key) => key !== "epipole-places")).toEqual([]);
        expect(besides).toEqual([]);
      });
      await test.step("axe finds nothing wrong in light", () => expectAccessible(page));
      await test.step("nor in dark", async () => {
        await page.emulateMedia({ colorScheme: "dark" });
        await expect(figures.locator(".root:not([data-theme=dark])")).toHaveCount(0);
        await expectAccessible(page, { colors: true });
      });
    });

    test("without script it has everything to read and to see", async ({ browser, library }) => {
      const context = await browser.newContext({ javaScriptEnabled: false });
      const page = await context.newPage();
      await page.goto(`${library}/${name}`);
      await expect(page.locator("h1")).toBeVisible();
      for (const figure of await page.locator("figure.epipole").all()) {
        await figure.scrollIntoViewIfNeeded();
        await expect(figure.locator("figcaption")).toBeVisible();
        const poster = figure.locator("img");
        await expect(poster).toBeVisible();
        expect((await poster.getAttribute("alt")).length).toBeGreaterThan(20);
        await expect.poll(() => poster.evaluate((image) => image.naturalWidth)).toBeGreaterThan(0);
      }
      await context.close();
    });

    test("a phone 360 px wide needs no sideways scroll", async ({ browser, library, complaints }) => {
      const context = await browser.newContext({
        viewport: { width: 360, height: 740 },
        deviceScaleFactor: 2,
        hasTouch: true,
        isMobile: true,
      });
      const page = await context.newPage();
      listen(page, complaints);
      await page.goto(`${library}/${name}`);
      await wake(page);
      // Sections without layout have no width.
      await expect(page.locator("article > section:not(.settled)")).toHaveCount(0);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(360);
      const cutOff = await page.locator(".formula").evaluateAll((formulas) => {
        for (const folded of document.querySelectorAll("details")) folded.open = true;
        const wide = formulas.filter((formula) => formula.scrollWidth > formula.clientWidth);
        return wide.map((formula) => formula.querySelector("annotation")?.textContent);
      });
      expect(cutOff, "formulas that are cut off").toEqual([]);
      await context.close();
    });
  });
}

if (book) {
  test("on a narrow page a link to a section lands on it", async ({ page, library }) => {
    const chapter = `${library}/epipolar.html`;
    const top = (id) => page.locator(`[id="${id}"]`).evaluate((heading) => heading.getBoundingClientRect().top);
    const lands = async (id) => {
      await expect.poll(() => top(id)).toBeLessThan(200);
      expect(await top(id)).toBeGreaterThanOrEqual(0);
    };
    await page.setViewportSize({ width: 390, height: 844 });
    await page.goto(chapter);
    const ids = await page.locator("article > section > h2").evaluateAll((list) => list.map(({ id }) => id));
    const far = ids.at(-2);
    // By hash in the page, before and after it has settled, and from another page.
    await page.evaluate((id) => (location.hash = id), far);
    await lands(far);
    await expect(page.locator("article > section:not(.settled)")).toHaveCount(0);
    await lands(far);
    await page.goto("about:blank");
    await page.goto(`${chapter}#${ids[4]}`);
    await page.waitForLoadState("networkidle");
    await lands(ids[4]);
  });
}

test("a note is in the margin, or where there is none unfolds at its mark, without a script", async ({ browser, library }) => {
  const context = await browser.newContext({ javaScriptEnabled: false, viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  await page.goto(`${library}/rays.html`);
  const note = page.locator(".note").first();
  const mark = page.getByRole("checkbox", { name: "Note 1" });
  await expect(note).toBeVisible();
  await expect(mark).toHaveCount(0);
  await page.setViewportSize({ width: 390, height: 844 });
  await expect(note).toBeHidden();
  await page.locator(".note-mark label").first().click();
  await expect(note).toBeVisible();
  await mark.focus();
  await page.keyboard.press("Space");
  await expect(note).toBeHidden();
  await page.emulateMedia({ media: "print" });
  await expect(note).toBeVisible();
  await context.close();
});

test("figures have their look before their own style sheet and script have come", async ({ page, library, complaints }) => {
  // Some browsers paint a tree before the style sheet of its `<link>` has loaded.
  await page.route(/assets[/](figure|index)-/, () => {});
  await page.goto(`${library}/epipolar.html`, { waitUntil: "commit" });
  const figure = page.locator("epipole-figure").first();
  await expect.poll(() => figure.evaluate(({ shadowRoot }) => shadowRoot?.adoptedStyleSheets.length ?? 0)).toBe(1);
  expect(await figure.evaluate(({ shadowRoot }) => shadowRoot.adoptedStyleSheets[0].cssRules.length)).toBeGreaterThan(100);
  complaints.length = 0;
});
