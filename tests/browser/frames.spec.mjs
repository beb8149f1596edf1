// The book's iframe pages of single figures, the list of all figures, and the page of each.

import { expect, expectAccessible, figures, ready, settled, test, told } from "./fixtures.mjs";
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

test("the list of all figures leads to the page of each, and from there to the chapters", async ({ page, library }) => {
  await page.goto(`${library}/gallery.html`);
  const items = page.locator(".gallery li");
  await expect(items).toHaveCount(figures.length);
  for (const { name, title } of figures) {
    await expect(items.filter({ has: page.locator(`a[href="figures/${name}.html"]`) })).toContainText(title);
    const html = await (await page.request.get(`${library}/figures/${name}.html`)).text();
    expect(html).toContain(`<epipole-figure name="${name}">`);
  }
  await items.filter({ hasText: "ransac-race" }).getByRole("link").click();
  await expect(page).toHaveURL(/figures\/ransac-race\.html$/);
  await expect(page.locator('.contents [aria-current="true"]')).toHaveText("All figures");
  await page.locator("article").getByRole("link", { name: /^Figure 10\./ }).first().click();
  await expect(page).toHaveURL(/sandbox\.html#/);
});

test("a reader chooses what a figure shows on other pages", async ({ page, library, complaints }) => {
  await page.goto(`${library}/figures/ransac-race.html`);
  const figure = page.locator("epipole-figure");
  const section = page.locator(".embedding");
  await ready(figure);
  await section.getByText("What can be set").click();
  await section.getByRole("checkbox", { name: "Show outliers" }).uncheck();
  await expect(figure.getByRole("slider", { name: "Outlier ratio" })).toBeHidden();
  const code = section.locator(".snippet code");
  await expect(code).toContainText(/controls="[a-z_ -]+"/);
  await expect(code).not.toContainText(/controls="[^"]*outliers/);
  await section.getByText("What can be read").click();
  for (const box of await section.locator('[data-shown-by="readouts"] input').all()) await box.uncheck();
  await section.getByLabel("Goals shown").selectOption("none");
  await expect(code).toContainText('readouts="none" goals="none"');
  await section.getByLabel("Kind of page").selectOption({ label: "Python notebook" });
  await expect(code).toContainText('readouts_shown="none", goals="none")');
  await expectAccessible(page);
  // axe measures by inline styles, which the policy forbids.
  complaints.length = 0;
  // Its page for frames takes the same words.
  await page.goto(await section.locator(".frame-page").evaluate((link) => link.href));
  await ready(figure);
  await expect(figure.getByRole("slider", { name: "Outlier ratio" })).toBeHidden();
  await page.goto(`${library}/figures/ransac-race.html`);
  await ready(figure);
  // The kind of page is kept.
  await expect(code).toHaveText('from epipole.figures import Figure\n\nFigure("ransac-race")');
  await section.getByLabel("Kind of page").selectOption({ label: "HTML" });
  // Ticked again, nothing is said about it.
  const box = section.getByRole("checkbox", { name: "Show outliers" });
  await section.getByText("What can be set").click();
  await box.uncheck();
  await box.check();
  await expect(code).not.toContainText("controls=");
});

test("the page of a figure has words to copy for the state that the reader sets", async ({ page, library }) => {
  await page.goto(`${library}/figures/ransac-race.html`);
  const figure = page.locator("epipole-figure");
  const section = page.locator(".embedding");
  await ready(figure);
  await settled(figure);
  const code = section.locator(".snippet code");
  await figure.evaluate((element) => (element.outliers = 0.6, element.flush()));
  await expect(code).toContainText('<epipole-figure name="ransac-race" outliers="0.60"></epipole-figure>');
  await expect(code).toContainText(`src="${library}/embed/epipole.js"`);
  const kinds = section.getByLabel("Kind of page");
  await kinds.selectOption({ label: "Python notebook" });
  await expect(code).toHaveText('from epipole.figures import Figure\n\nFigure("ransac-race", outliers=0.6)');
  await kinds.selectOption({ label: "Frame (courses, wikis)" });
  // The copied snippet works.
  const words = await code.textContent();
  const address = /src="([^"]+)"/.exec(words)[1];
  expect(address).toBe(`${library}/embed/ransac-race.html?outliers=0.60`);
  await expect(section.locator(".frame-page")).toHaveAttribute("href", /\?outliers=0\.60$/);
  await page.goto(address);
  await ready(page.locator("epipole-figure"));
  expect((await told(page.locator("epipole-figure"))).state).toEqual({ outliers: "0.60" });
});
