// Thumbnails in chapters that animate when the reader looks at them.

import { expect, test } from "./fixtures.mjs";

/** The card with an animated figure. */
const living = (page) => page.locator(".small:has(epipole-figure.awake)");

/** The canvas of a card's figure, as a data URL. */
const pixels = (page) =>
  page.locator(".small epipole-figure").evaluate((figure) => figure.shadowRoot.querySelector("canvas").toDataURL());

test("a small picture moves under the mouse and with the focus, one at a time, and the link stays a link", async ({ page, library }) => {
  await page.goto(`${library}/connections.html`);
  const cards = page.locator(".small[data-moves]");
  expect(await cards.count()).toBeGreaterThan(8);
  await expect(page.locator(".small epipole-figure")).toHaveCount(0);
  const card = page.locator('.small[data-figure="four-poses"]');
  await card.scrollIntoViewIfNeeded();
  const still = await card.locator("picture").boundingBox();
  await card.hover();
  await expect(living(page)).toHaveCount(1, { timeout: 30_000 });
  expect(await card.locator("picture").boundingBox()).toEqual(still);
  const first = await pixels(page);
  await expect.poll(() => pixels(page)).not.toBe(first);
  const other = page.locator('.small[data-figure="same-picture"]');
  await other.focus();
  await expect(living(page)).toHaveCount(1, { timeout: 30_000 });
  await expect(living(page)).toHaveAttribute("data-figure", "same-picture");
  // The figure is inert and hidden from screen readers, and its goals do not count.
  const inside = other.locator("epipole-figure");
  await expect(inside).toHaveAttribute("aria-hidden", "true");
  expect(await inside.evaluate(({ inert }) => inert)).toBe(true);
  await page.mouse.move(0, 0);
  await page.evaluate(() => document.activeElement.blur());
  await expect(page.locator(".small epipole-figure")).toHaveCount(0);
  await other.click();
  await expect(page).toHaveURL(/rays\.html$/);
});

test("without a wish for motion small pictures are still", async ({ page, library }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto(`${library}/connections.html`);
  await page.locator('.small[data-figure="four-poses"]').hover();
  await page.waitForTimeout(1000);
  await expect(page.locator(".small epipole-figure")).toHaveCount(0);
});
