// The book's iframe pages of single figures, and the gallery page.

import { expect, figures, ready, settled, test, told } from "./fixtures.mjs";
import { book } from "./places.mjs";

test.skip(!book, "these are pages of the book");

test("every figure has its page, and works there under the policy of the book", async ({ page, library }) => {
  for (const { name, title } of figures) {
    await page.goto(`${library}/embed/${name}.html`);
    expect(await page.title()).toContain(title);
    await expect(page.locator("epipole-figure")).toHaveAttribute("data-ready", "");
    await expect(page.locator("epipole-figure .notice")).toBeHidden();
  }
});

test("the address sets the figure and what stands beside it; Reset comes back to that", async ({ page, library }) => {
  await page.setViewportSize({ width: 700, height: 420 });
  await page.goto(`${library}/embed/ransac-race.html?outliers=0.3&points=40&compact&theme=dark&goals=none`);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  expect((await told(figure)).state).toEqual({ outliers: "0.30", points: "40" });
  await expect(figure.locator(".root")).toHaveAttribute("data-theme", "dark");
  expect(await page.evaluate(() => [document.documentElement.scrollHeight, innerHeight])).toEqual([420, 420]);
  await expect(figure.locator(".bar").getByRole("button", { name: "Run" })).toBeInViewport({ ratio: 1 });
  await figure.evaluate((element) => (element.points = 20));
  await figure.getByRole("button", { name: "More" }).click();
  await figure.getByRole("button", { name: "Reset" }).click();
  expect((await told(figure)).state).toEqual({ outliers: "0.30", points: "40" });
  const link = new URL(await figure.evaluate((element) => element.permalink));
  expect(Object.fromEntries(link.searchParams)).toEqual({ compact: "", theme: "dark", goals: "none", outliers: "0.30", points: "40" });
});

test("a parameter that there is not is told in the figure", async ({ page, library }) => {
  await page.goto(`${library}/embed/ransac-race.html?outlier=0.4&onclick=alert(1)`);
  const figure = page.locator("epipole-figure");
  await expect(figure.locator(".notice")).toContainText('no parameter "outlier"');
  expect(await figure.getAttribute("onclick")).toBe(null);
});

test("without script a frame shows the picture and says what is on it", async ({ browser, library }) => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  await page.goto(`${library}/embed/ransac-race.html`);
  await expect.poll(() => page.locator("img").evaluate((image) => image.naturalWidth)).toBeGreaterThan(0);
  await expect(page.locator("noscript p")).toContainText("It moves where scripts are allowed");
  await context.close();
});

test("the page of all figures has words to copy for the state that the reader sets", async ({ page, library }) => {
  await page.goto(`${library}/gallery.html`);
  const section = page.locator('.gallery[data-name="ransac-race"]');
  const figure = section.locator("epipole-figure");
  await ready(figure);
  await settled(figure);
  const code = section.locator(".snippet code");
  await figure.evaluate((element) => (element.outliers = 0.6, element.flush()));
  await expect(code).toContainText('<epipole-figure name="ransac-race" outliers="0.60"></epipole-figure>');
  await expect(code).toContainText(`src="${library}/embed/epipole.js"`);
  const kinds = section.getByLabel("Kind of page");
  await kinds.selectOption({ label: "Python notebook" });
  await expect(code).toHaveText('from epipole.figures import Figure\n\nFigure("ransac-race", outliers=0.6)');
  await expect(page.locator(".gallery .snippet code").first()).toContainText('Figure("');
  await kinds.selectOption({ label: "Frame (courses, wikis)" });
  // The copied snippet works.
  const words = await code.textContent();
  const address = /src="([^"]+)"/.exec(words)[1];
  expect(address).toBe(`${library}/embed/ransac-race.html?outliers=0.60`);
  await expect(section.locator(".own-page")).toHaveAttribute("href", /\?outliers=0\.60$/);
  await page.goto(address);
  await ready(page.locator("epipole-figure"));
  expect((await told(page.locator("epipole-figure"))).state).toEqual({ outliers: "0.60" });
});
