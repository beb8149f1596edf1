// Terms of the text: their cards, and the glossary.

import { expect, expectAccessible, test } from "./fixtures.mjs";
import { book } from "./places.mjs";

test.skip(!book, "the book is not what is tested");

const CHAPTER = "eight-point.html";
const terms = (page) => page.locator("article a.term:visible");
const card = (page) => page.locator(".term-card");

/** The first term with a card that says so. */
async function expectCard(page, term) {
  await expect(card(page)).toHaveCount(1);
  const key = (await term.getAttribute("href")).split("#")[1];
  await expect(card(page).locator("strong")).toHaveText(key.replaceAll("-", " "));
  await expect(card(page).locator("a.ref").first()).toHaveText(/^Chapter \d+$/);
  const [word, shown] = [await term.boundingBox(), await card(page).boundingBox()];
  const { width, height } = page.viewportSize();
  expect(shown.x).toBeGreaterThanOrEqual(0);
  expect(shown.x + shown.width).toBeLessThanOrEqual(width);
  expect(shown.y + shown.height).toBeLessThanOrEqual(height);
  // It covers no letter of its word, and is near it.
  const apart = Math.max(shown.y - word.y - word.height, word.y - shown.y - shown.height);
  expect(apart).toBeGreaterThan(0);
  expect(apart).toBeLessThan(20);
}

test("pointing at a term shows its entry, which the pointer may enter", async ({ page, library }) => {
  await page.goto(`${library}/${CHAPTER}`);
  const term = terms(page).first();
  await term.hover();
  await expectCard(page, term);
  await expect(term).toHaveAttribute("aria-describedby", "term-card");
  const link = card(page).locator("a.ref").first();
  await link.hover();
  await page.waitForTimeout(400);
  await expect(card(page)).toHaveCount(1);
  await page.mouse.move(2, 2);
  await expect(card(page)).toHaveCount(0);
  await expect(term).not.toHaveAttribute("aria-describedby");
  await term.hover();
  await link.click();
  await expect(page).toHaveURL(/epipolar\.html#term-/);
  await expect(page.locator("dfn:target")).toBeVisible();
});

test("a term is reached by keys, and Escape closes its card", async ({ page, library }) => {
  await page.goto(`${library}/${CHAPTER}`);
  const term = terms(page).nth(1);
  await term.evaluate((link) => {
    // Just before the term, where the Tab key goes on from.
    const before = document.createElement("button");
    before.id = "before";
    link.before(before);
    before.focus();
  });
  await page.keyboard.press("Tab");
  await expectCard(page, term);
  await page.keyboard.press("Tab");
  await expect(card(page).locator("a").first()).toBeFocused();
  await page.keyboard.press("Escape");
  await expect(card(page)).toHaveCount(0);
  await expect(term).toBeFocused();
  await page.keyboard.press("Enter");
  await expect(page).toHaveURL(/glossary\.html#/);
});

test("a tap shows the entry, a second one leads to it", async ({ browser, library }) => {
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });
  const page = await context.newPage();
  await page.goto(`${library}/${CHAPTER}`);
  await page.waitForLoadState("networkidle");
  for (const term of (await terms(page).all()).slice(0, 4)) {
    await term.tap();
    await expectCard(page, term);
    await page.locator("h1").tap();
    await expect(card(page)).toHaveCount(0);
  }
  const term = terms(page).first();
  await term.tap();
  await expectCard(page, term);
  await term.tap();
  await expect(page).toHaveURL(/glossary\.html#/);
  await context.close();
});

test("without a network or an entry, a term is a link", async ({ page, library, complaints }) => {
  await page.route(/glossary\.html/, (route) => (route.request().resourceType() === "fetch" ? route.abort() : route.continue()));
  await page.goto(`${library}/${CHAPTER}`);
  const term = terms(page).first();
  await term.hover();
  await page.waitForTimeout(400);
  await expect(card(page)).toHaveCount(0);
  await term.click();
  await expect(page).toHaveURL(/glossary\.html#/);
  expect(complaints.filter((text) => !/ERR_FAILED/.test(text))).toEqual([]);
  complaints.length = 0;
});

test("cards are accessible in both themes", async ({ page, library, complaints }) => {
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    await page.goto(`${library}/${CHAPTER}`);
    await terms(page).first().hover();
    await expect(card(page)).toHaveCount(1);
    await expectAccessible(page, { within: ".term-card", colors: true });
  }
  // The checker measures by inline styles, which the policy forbids.
  complaints.length = 0;
});

test("the glossary lists every term once, with links that lead to its definition", async ({ page, library }) => {
  await page.goto(`${library}/glossary.html`);
  const names = await page.locator(".glossary dt").allTextContents();
  expect(names.length).toBeGreaterThan(60);
  expect(new Set(names).size).toBe(names.length);
  await page.getByRole("link", { name: "Chapter 4" }).first().click();
  await expect(page.locator("dfn:target")).toBeInViewport();
});
