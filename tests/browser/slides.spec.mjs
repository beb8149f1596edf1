// Slides of the chapters: everything fits, figures live, two windows turn together.

import { readdirSync } from "node:fs";
import { join } from "node:path";
import { expect, expectAccessible, ready, test } from "./fixtures.mjs";
import { book } from "./places.mjs";

test.skip(!book, "the book is not what is tested");
test.use({ viewport: { width: 1280, height: 720 } });

const decks = book ? readdirSync(join(book, "slides")).filter((name) => name.endsWith(".html")) : [];

const started = (page) => expect(page.locator(".reveal.ready")).toBeVisible();
const present = (page) => page.locator(".slides section.present section.present");

/** Shows one slide after the other; returns `[heading, what is wrong]` of those that do not fit. */
async function misfits() {
  const wrong = [];
  const slides = [...document.querySelectorAll(".slides > section > section")];
  const stacks = [...document.querySelectorAll(".slides > section")];
  for (const slide of slides) {
    const stack = slide.parentElement;
    location.hash = `#/${stacks.indexOf(stack)}/${[...stack.children].indexOf(slide)}`;
    await new Promise((done) => setTimeout(done, 30));
    const name = `${slide.dataset.kind}: ${slide.querySelector("h2").textContent.trim()}`;
    if (!slide.classList.contains("present")) wrong.push([name, "not shown"]);
    if (slide.scrollHeight > slide.clientHeight + 1) wrong.push([name, `${slide.scrollHeight} px high`]);
    if (slide.scrollWidth > slide.clientWidth + 1) wrong.push([name, `${slide.scrollWidth} px wide`]);
    const figure = slide.querySelector("epipole-figure");
    if (figure && figure.offsetHeight < 400) wrong.push([name, `figure of ${figure.offsetHeight} px`]);
  }
  return wrong;
}

test("every slide of every deck fits", async ({ page, library, complaints }) => {
  test.slow();
  expect(decks.length).toBeGreaterThan(10);
  const wrong = {};
  for (const deck of decks) {
    await page.goto(`${library}/slides/${deck}`);
    await started(page);
    const found = await page.evaluate(misfits);
    if (found.length > 0) wrong[deck] = found;
  }
  expect(wrong).toEqual({});
  expect(complaints).toEqual([]);
});

for (const theme of ["light", "dark"]) {
  test(`axe finds nothing wrong with words, figures and questions, ${theme}`, async ({ page, library }) => {
    await page.emulateMedia({ colorScheme: theme, reducedMotion: "reduce" });
    await page.goto(`${library}/slides/sfm.html`);
    await started(page);
    for (const kind of ["words", "formula", "figure", "table", "list", "question"]) {
      const place = await page.locator(`[data-kind=${kind}]`).first().evaluate((slide) => {
        const at = (element) => [...element.parentElement.children].indexOf(element);
        return `#/${at(slide.parentElement)}/${at(slide)}`;
      });
      await page.evaluate((hash) => (location.hash = hash), place);
      await expect(present(page)).toHaveAttribute("data-kind", kind);
      await expectAccessible(page);
    }
  });
}

test("keys turn the slides, and words below a figure operate it", async ({ page, library }) => {
  await page.goto(`${library}/slides/stereo.html`);
  await started(page);
  await expect(present(page).getByRole("heading")).toContainText("Stereo");
  await page.keyboard.press("ArrowDown");
  const figure = present(page).locator("epipole-figure");
  await ready(figure);
  const disparity = () => figure.evaluate((element) => element.readouts.disparity);
  const before = await disparity();
  await present(page).getByRole("button", { name: "compare" }).click();
  await expect.poll(disparity).toBeGreaterThan(1.9 * before);
  await page.keyboard.press("ArrowRight");
  await expect(present(page)).toHaveAttribute("data-kind", "formula");
  await expect.poll(() => new URL(page.url()).hash).toBe("#/1");
  await page.getByRole("link", { name: "Chapter 8" }).click();
  await expect(page).toHaveURL(/stereo\.html$/);
  await page.getByRole("link", { name: "Slides of this chapter" }).click();
  await started(page);
});

test("the speaker's window has the notes, and turns both", async ({ page, library }) => {
  await page.goto(`${library}/slides/stereo.html#/9/2`);
  await started(page);
  await expect(page.locator(".speaker-notes")).toBeHidden();
  const opened = page.waitForEvent("popup");
  await page.getByRole("button", { name: "Speaker view" }).click();
  const speaker = await opened;
  await started(speaker);
  await expect(speaker.locator(".speaker-notes")).toContainText("Every disparity doubles");
  await speaker.keyboard.press("ArrowLeft");
  await expect.poll(() => new URL(page.url()).hash).toBe("#/8");
  await page.keyboard.press("ArrowLeft");
  await expect.poll(() => new URL(speaker.url()).hash).toMatch(/^#\/7/);
});

test("without script a deck leads to its chapter", async ({ browser, library }) => {
  const page = await browser.newPage({ javaScriptEnabled: false });
  await page.goto(`${library}/slides/stereo.html`);
  await page.locator("noscript a").click();
  await expect(page).toHaveURL(/stereo\.html$/);
  await page.close();
});
