// Sentences of the book that operate its figures, live numbers in them, and room for figures on
// pages.

import { readdirSync } from "node:fs";
import { expect, expectAccessible, ready, test } from "./fixtures.mjs";
import { book } from "./places.mjs";

const chapters = book ? readdirSync(book).filter((name) => name.endsWith(".html") && name !== "404.html") : [];
const WIDTHS = [320, 390, 500, 600, 768, 900, 1024, 1200, 1280, 1440, 1920];
/** Width of pages from which on notes are in the margin. */
const MARGIN_PX = 1200;

/** The figure that a sentence operates. */
async function figureOf(page, words) {
  return page.locator(`#${await words.getAttribute("data-figure")} epipole-figure`);
}

test("words in a sentence take a figure where they say, by mouse and by key, and numbers follow", async ({ page, library }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto(`${library}/stereo.html`);
  const words = page.locator(".do").nth(1); // The first one hides the number, for a guess.
  const live = page.locator(".live[data-shows=disparity]").first();
  await expect(words).toHaveRole("button");
  await expect(live).toHaveText("30.0 px");
  await words.click();
  const figure = await figureOf(page, words);
  await expect(live).toHaveText("60.0 px");
  expect(await figure.evaluate((element) => element.readoutText("disparity"))).toBe("60.0 px");
  await figure.evaluate((element) => element.glide({ object: "0.362,2.8" }));
  await expect(live).toHaveText("30.0 px");
  await words.focus();
  await expect(words).toBeFocused();
  await page.keyboard.press("Enter");
  await expect(live).toHaveText("60.0 px");
});

/** Screens on which a sentence and the picture that it moves are seen together. */
const SCREENS = [{ width: 1280, height: 720 }, { width: 390, height: 844 }];

/** Whether words and picture are on the screen, and the words uncovered. Runs in the page. */
function together(words) {
  const figure = document.getElementById(words.dataset.figure);
  const picture = figure.querySelector("epipole-figure").shadowRoot.querySelector(".sheet").getBoundingClientRect();
  const isIn = ({ top, bottom, left, right }) => top >= -1 && left >= -1 && bottom <= innerHeight + 1 && right <= innerWidth + 1;
  const line = words.getClientRects()[0];
  const hit = document.elementFromPoint(line.left + 2, line.top + line.height / 2);
  return {
    picture: isIn(picture) && picture.height > 60,
    words: isIn(words.getBoundingClientRect()) && words.contains(hit),
  };
}

for (const name of chapters) {
  for (const viewport of SCREENS) {
    test(`every button of ${name} takes its figure exactly where it says, both in sight at ${viewport.width} px`, async ({ page, library }) => {
      test.setTimeout(120_000);
      await page.setViewportSize(viewport);
      await page.emulateMedia({ reducedMotion: "reduce" });
      await page.goto(`${library}/${name}`);
      for (const words of await page.locator(".do").all()) {
        const figure = await figureOf(page, words);
        await expect(figure).toHaveCount(1);
        const wanted = JSON.parse(await words.getAttribute("data-parameters"));
        await words.evaluate((element) => element.scrollIntoView({ block: "center" }));
        await words.click();
        await expect(figure).toHaveAttribute("data-ready", "");
        // Displayed values of the controls: numbers with units, switches, options by label.
        const asked = Object.entries(wanted).filter(([, value]) => value === "true" || value === "false" || !Number.isNaN(Number(value)));
        const expected = asked.map(([, value]) => (value === "true" ? "on" : value === "false" ? "off" : Number(value)));
        const says = () =>
          figure.evaluate((element, keys) => keys.map((key) => element.controlText(key)), asked.map(([key]) => key));
        const read = (text) => (/^(on|off)$/.test(text) ? text : parseFloat(text?.replace("−", "-")));
        const message = `${name}: ${await words.textContent()}`;
        await expect.poll(async () => (await says()).map(read), { message }).toEqual(expected);
        await expect.poll(() => words.evaluate(together), { message }).toMatchObject({ picture: true, words: true });
      }
    });
  }
}

test("a sentence finds its figure while another one leaves its dock, on a slow machine, too", async ({ page, library }) => {
  await page.setViewportSize(SCREENS[0]);
  await page.emulateMedia({ reducedMotion: "reduce" });
  const session = await page.context().newCDPSession(page);
  await session.send("Emulation.setCPUThrottlingRate", { rate: 4 });
  await page.goto(`${library}/sandbox.html`);
  for (const text of ["Make the threshold e", "first outliers"]) {
    const words = page.locator(".do", { hasText: text });
    const figure = await figureOf(page, words);
    await words.evaluate((element) => element.scrollIntoView({ block: "center" }));
    await words.click();
    await expect(figure).toHaveAttribute("data-ready", "");
    await expect.poll(() => words.evaluate(together), { message: text }).toMatchObject({ picture: true, words: true });
  }
});

test("late changes of layout keep a sentence and its figure in sight, until the reader does anything", async ({ page, library }) => {
  await page.setViewportSize(SCREENS[0]);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto(`${library}/sandbox.html`);
  await page.evaluate(() => document.fonts.ready);
  for (const words of (await page.locator(".do").all()).slice(0, 2)) {
    await words.evaluate((element) => element.scrollIntoView({ block: "center" }));
    await words.click();
    await expect(await figureOf(page, words)).toHaveAttribute("data-ready", "");
    const inSight = () => words.evaluate(together);
    await expect.poll(inSight).toMatchObject({ picture: true, words: true });
    await page.evaluate(() => {
      document.documentElement.style.overflowAnchor = "none";
      const late = document.createElement("div");
      late.id = "late";
      late.style.blockSize = "700px";
      document.querySelector("article").prepend(late);
    });
    await expect.poll(inSight).toMatchObject({ picture: true, words: true });
    await page.keyboard.press("Shift");
    const scroll = await page.evaluate(async () => {
      const before = scrollY;
      document.getElementById("late").remove();
      for (let frame = 0; frame < 10; frame++) await new Promise(requestAnimationFrame);
      return [before, scrollY];
    });
    expect(scroll[1], "a reader who has pressed a key is left alone").toBe(scroll[0]);
  }
});

test("a docked figure goes home when closed, reached or left behind, and moves no text", async ({ page, library }) => {
  await page.setViewportSize(SCREENS[0]);
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto(`${library}/epipolar.html`);
  // A late font breaks lines anew, which is not the dock's doing.
  await page.evaluate(() => document.fonts.ready);
  const words = page.locator(".do", { hasText: "Take p up to the wall" });
  const figure = await figureOf(page, words);
  const box = page.locator(`#${await words.getAttribute("data-figure")}`);
  const scroll = () => page.evaluate(() => scrollY);
  const dock = async () => {
    await words.evaluate((element) => element.scrollIntoView({ block: "center" }));
    const [at, height] = [await scroll(), await page.evaluate(() => document.documentElement.scrollHeight)];
    await words.click();
    await expect(box).toHaveClass(/docked/);
    await expect(figure).toHaveAttribute("data-ready", "");
    expect(await scroll()).toBe(at);
    expect(await page.evaluate(() => document.documentElement.scrollHeight)).toBe(height);
  };
  await dock();
  await page.keyboard.press("Escape");
  await expect(box).not.toHaveClass(/docked/);
  await expect(words).toBeFocused();
  await dock();
  await page.getByRole("button", { name: "Put back" }).click();
  await expect(box).not.toHaveClass(/docked/);
  expect(await figure.evaluate((element) => element.compact)).toBe(false);
  await dock();
  // A little way on the figure stays, and leads back to its sentence.
  await page.mouse.wheel(0, 600);
  await page.getByRole("button", { name: "Back to the text" }).click();
  await expect(words).toBeInViewport();
  await expect(box).toHaveClass(/docked/);
  await page.mouse.move(640, 600);
  const left = await scroll();
  await page.mouse.wheel(0, 3000);
  await expect(box).not.toHaveClass(/docked/);
  // The wheel scrolls over several frames, and would go on under the next click.
  await expect.poll(scroll).toBe(left + 3000);
  await dock();
  await box.locator(".dock-bar .figure-number").click();
  await expect(box).not.toHaveClass(/docked/);
  await expect(figure).toBeInViewport();
  await page.getByRole("button", { name: "Back to the text" }).click();
  await expect(words).toBeInViewport();
  await expect(words).toBeFocused();
  await expect(page.getByRole("button", { name: "Back to the text" })).toHaveCount(0);
});

test.describe("docked", () => {
  // axe copies elements with styles of their own, which the policy of the book forbids.
  test.use({ bypassCSP: true });

  test("a docked figure is accessible, and is not printed as such", async ({ page, library }) => {
    await page.setViewportSize(SCREENS[0]);
    await page.goto(`${library}/epipolar.html`);
    const words = page.locator(".do", { hasText: "Take p up to the wall" });
    await words.evaluate((element) => element.scrollIntoView({ block: "center" }));
    await words.click();
    const box = page.locator(".docked");
    await ready(box.locator("epipole-figure"));
    for (const colorScheme of ["light", "dark"]) {
      await page.emulateMedia({ colorScheme, reducedMotion: "reduce" });
      await expectAccessible(page, { within: ".docked" });
    }
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    await expect(box).toHaveCount(0);
  });
});

test("without a script sentences read as plain words", async ({ browser, library }) => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(`${library}/stereo.html`);
  await expect(page.locator(".do").first()).not.toHaveAttribute("role");
  await expect(page.locator(".live").first()).toHaveText("2.80 m");
  const looks = (locator) =>
    locator.evaluate((element) => {
      const { color, backgroundColor, textDecorationLine, cursor } = getComputedStyle(element);
      return [color, backgroundColor, textDecorationLine, cursor].join();
    });
  const [words, paragraph] = [page.locator(".do").first(), page.locator("p:has(.do)").first()];
  expect(await looks(words)).toBe(await looks(paragraph));
  await context.close();
});

/** Number of notes in the margin that overlap others, figures, listings or tables. In the page. */
function overlappingNotes() {
  const boxes = (selector) => [...document.querySelectorAll(selector)].map((found) => found.getBoundingClientRect());
  const notes = boxes(".note[role=note]");
  const others = boxes("figure.epipole, article pre, article .table");
  const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;
  return notes.flatMap((note, index) => [...others, ...notes.slice(index + 1)].filter((box) => meet(note, box))).length;
}

for (const name of chapters) {
  test(`${name} does not scroll sideways, posters are those of their rooms, and notes in the margin meet nothing`, async ({ page, library }) => {
    await page.goto(`${library}/${name}`);
    await test.step("notes in the margin meet neither figures nor listings nor one another", async () => {
      for (const width of WIDTHS.filter((width) => width >= MARGIN_PX)) {
        await page.setViewportSize({ width, height: 800 });
        expect(await page.evaluate(overlappingNotes), `${name} at ${width}`).toBe(0);
      }
    });

    await test.step("it does not scroll sideways, and posters are those of the rooms that they stand in", async () => {
      // Lay out distant sections as well, to measure their width.
      await page.evaluate(() => {
        for (const section of document.querySelectorAll("article section")) section.style.contentVisibility = "visible";
      });
      for (const width of WIDTHS) {
        await page.setViewportSize({ width, height: 800 });
        const seen = await page.evaluate(() => ({
          overflow: document.documentElement.scrollWidth - innerWidth,
          figures: [...document.querySelectorAll("figure.epipole")].map((figure) => {
            const { left, right, width } = figure.getBoundingClientRect();
            const sources = [...figure.querySelectorAll("source")].filter((source) => matchMedia(source.media).matches);
            return { left, right, width, poster: Number(sources[0]?.width ?? 0) / 2 };
          }),
        }));
        expect(seen.overflow, `${name} at ${width}`).toBeLessThanOrEqual(0);
        for (const figure of seen.figures) {
          expect(figure.left, `${name} at ${width}`).toBeGreaterThanOrEqual(0);
          expect(figure.right, `${name} at ${width}`).toBeLessThanOrEqual(width);
          const rooms = figure.width < 500 ? [360] : figure.width < 860 ? [720] : [720, 1088];
          expect(rooms, `${name} at ${width}: a figure of ${figure.width} px`).toContain(figure.poster);
        }
      }
    });
  });
}

test("the column of contents folds away, stays so, and comes back by key", async ({ page, library }) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  await page.goto(`${library}/ransac.html`);
  const button = page.getByRole("button", { name: "Column of contents" });
  const contents = page.locator("#contents");
  const figure = page.locator("figure.epipole").first();
  await expect(button).toHaveAttribute("aria-expanded", "true");
  await expect(contents).toBeVisible();
  const before = (await figure.boundingBox()).width;
  await button.click();
  await expect(button).toHaveAttribute("aria-expanded", "false");
  await expect(contents).toBeHidden();
  expect((await figure.boundingBox()).width).toBeGreaterThan(before);
  await page.reload();
  await expect(contents).toBeHidden();
  await button.focus();
  await page.keyboard.press("Enter");
  await expect(contents).toBeVisible();
  await page.setViewportSize({ width: 1024, height: 768 });
  await expect(button).toBeHidden();
  await expect(contents).toBeHidden();
});
