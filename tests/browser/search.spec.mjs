// Search of the book: abbreviations find what they stand for, formulas are in the excerpts.

import { expect, test } from "./fixtures.mjs";
import { book } from "./places.mjs";

test.skip(!book, "the book is not what is tested");

test("abbreviations lead to the sections that explain them, and excerpts keep formulas", async ({ page, library }) => {
  await page.goto(`${library}/index.html`);
  await page.locator(".search-button").click();
  const input = page.getByRole("searchbox");
  const results = page.locator(".search-results a");
  for (const [query, section] of [
    ["SVD", "When rays miss: singular values"],
    ["sgm", "Asking the neighbors: semi-global matching"],
    ["LM", "Levenberg and Marquardt"],
    ["pnp", "The first points, and the next photograph: PnP"],
  ]) {
    await input.fill(query);
    await expect(results.first().locator(".where")).toContainText(section);
  }
  await input.fill("every true match satisfies");
  await expect(results.first()).toContainText("ℓ′ = Fx");
  await expect(results.first().locator(".excerpt")).not.toContainText("One matrix for all lines");
});
