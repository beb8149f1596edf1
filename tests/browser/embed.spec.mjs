// A page of someone else embeds a figure by a script tag alone.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, figures, ready, test, told } from "./fixtures.mjs";
import { here, script } from "./places.mjs";
import { serve } from "./server.mjs";

const { name } = figures[0];

/** The page as a teacher writes it, with the address of the book put in. */
async function elsewhere(site) {
  const page = readFileSync(join(here, "pages/embed.html"), "utf8");
  const html = page.replace("https://book.example/embed/epipole.js", `${site}/elements/${script}`);
  return serve({ mounts: { "": () => html }, policy: false });
}

test("script tag, attributes, properties and events work from another origin", async ({ page, site }) => {
  const other = await elsewhere(site);
  expect(other.origin).not.toBe(site);
  await page.goto(other.origin);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  expect((await told(figure)).state).toEqual({ outliers: "0.20", seed: "3" });
  await expect(page.locator("#heard")).toContainText("epipole-ready");

  await figure.evaluate((element) => element.setAttribute("outliers", "0.6"));
  await expect.poll(async () => (await told(figure)).state.outliers).toBe("0.60");
  await expect(page.locator("#heard")).toContainText('epipole-change {"outliers":"0.60"');
  await expect(page.locator("#heard")).toContainText("epipole-readout");

  await figure.evaluate((element) => (element.outliers = 0));
  expect(await figure.evaluate((element) => (element.flush(), element.outliers))).toBe(0);
  await expect(page.locator("#heard")).toContainText("epipole-challenge");

  await figure.evaluate((element) => element.removeAttribute("outliers"));
  await expect.poll(async () => (await told(figure)).state.outliers).toBe(undefined);
  await figure.evaluate((element) => element.setAttribute("outliers", "lots"));
  await expect(figure.locator(".notice")).toContainText('"lots" is not a value of outliers');
  await other.close();
});

test("a property set before the figure is there counts", async ({ page, site }) => {
  const other = await elsewhere(site);
  await page.goto(other.origin);
  await page.evaluate(() => {
    const figure = document.createElement("epipole-figure");
    figure.setAttribute("name", "ransac-race");
    figure.points = 20;
    document.body.prepend(figure);
  });
  const figure = page.locator("epipole-figure").first();
  await ready(figure);
  expect((await told(figure)).state.points).toBe("20");
  await other.close();
});

test("an embedded figure restores an unprefixed state and scrolls to itself", async ({ page, site }) => {
  const other = await elsewhere(site);
  await page.goto(`${other.origin}/?points=30&utm_source=letter`);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  expect((await told(figure)).state.points).toBe("30");
  await expect(figure).toBeInViewport();
  const link = await figure.evaluate((element) => element.permalink);
  const query = new URL(link).searchParams;
  expect(Object.fromEntries(query)).toEqual({
    utm_source: "letter",
    points: "30",
    outliers: "0.20",
    seed: "3",
  });
  await other.close();
});

test("the link is shown where it cannot be copied", async ({ page, site }) => {
  const other = await elsewhere(site);
  await page.addInitScript(() => {
    navigator.clipboard.writeText = () => Promise.reject(new Error("not allowed"));
  });
  await page.goto(other.origin);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  await figure.getByRole("button", { name: "Copy link" }).click();
  const shown = figure.getByLabel("Link to this state");
  await expect(shown).toBeFocused();
  await expect(shown).toHaveValue(await figure.evaluate((element) => element.permalink));
  await other.close();
});

test("the link is copied where it can be", async ({ page, site, context }) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  const other = await elsewhere(site);
  await page.goto(other.origin);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  await figure.getByRole("button", { name: "Copy link" }).click();
  await expect(figure.getByRole("button", { name: "Copied" })).toBeVisible();
  expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(
    await figure.evaluate((element) => element.permalink),
  );
  await other.close();
});

test(`nothing is loaded for ${name} before it nears the reader`, async ({ page, site }) => {
  const other = await elsewhere(site);
  const modules = [];
  page.on("request", (request) => request.url().endsWith(".wasm") && modules.push(request.url()));
  await page.goto(`${other.origin}/?far`);
  await page.evaluate(() => customElements.whenDefined("epipole-figure"));
  await page.waitForLoadState("networkidle");
  expect(modules).toEqual([]);
  await ready(page.locator("epipole-figure"));
  expect(modules.length).toBe(1);
  await other.close();
});
