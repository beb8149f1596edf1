// A page of someone else embeds a figure by a script tag alone.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, plain, ready, test, told } from "./fixtures.mjs";
import { here, script } from "./places.mjs";
import { serve } from "./server.mjs";

const name = plain;

/** The page as a teacher writes it, with the address of the book put in. */
async function elsewhere(site, above = "2500px") {
  const page = readFileSync(join(here, "pages/embed.html"), "utf8").replace("2500px", above);
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

test("in a frame a figure with parameters in its address leaves the page around it where it is", async ({ page, site }) => {
  const other = await elsewhere(site, "20px");
  const frame = `<iframe src="${other.origin}/?points=30" width="900" height="500"></iframe>`;
  const outer = await serve({
    mounts: { "": () => `<!doctype html><title>A course</title><p style="height: 600px">Text</p>${frame}<p style="height: 3000px">` },
    policy: false,
  });
  await page.goto(outer.origin);
  const figure = page.frameLocator("iframe").locator("epipole-figure");
  await expect(figure).toHaveAttribute("data-ready", "");
  expect(await page.evaluate(() => scrollY)).toBe(0);
  const inside = page.frames()[1];
  expect(await inside.evaluate(() => [scrollY, document.activeElement.localName])).toEqual([0, "body"]);
  await other.close();
  await outer.close();
});

test("a page's own switch of colors is followed, and so is a style sheet that comes later", async ({ page, site }) => {
  const other = await elsewhere(site);
  await page.goto(other.origin);
  const root = page.locator("epipole-figure .root");
  await ready(page.locator("epipole-figure"));
  await expect(root).toHaveAttribute("data-theme", "light");
  // As a site generator does it: a name of its own on the body, and colors that blend.
  await page.evaluate(() => {
    const sheet = document.createElement("style");
    sheet.textContent = `
      body { background: #fff; transition: background 250ms }
      [data-md-color-scheme="slate"] { background: #1e2129 }`;
    document.head.append(sheet);
    document.body.setAttribute("data-md-color-scheme", "slate");
  });
  await expect(root).toHaveAttribute("data-theme", "dark", { timeout: 1000 });
  await page.evaluate(() => document.body.removeAttribute("data-md-color-scheme"));
  await expect(root).toHaveAttribute("data-theme", "light", { timeout: 1000 });
  await page.evaluate(() => {
    const sheet = document.createElement("style");
    sheet.textContent = "body { background: #000; transition: none }";
    document.head.append(sheet);
  });
  await expect(root).toHaveAttribute("data-theme", "dark", { timeout: 1000 });
  await other.close();
});

test("what is around the shadow tree that a figure stands in decides its colors", async ({ page, site }) => {
  const other = await elsewhere(site);
  await page.goto(other.origin);
  await page.evaluate(() => {
    const host = document.createElement("div");
    host.style.background = "rgb(20, 20, 30)";
    const figure = document.createElement("epipole-figure");
    figure.setAttribute("name", "ransac-race");
    host.attachShadow({ mode: "open" }).append(figure);
    document.body.prepend(host);
  });
  const figure = page.locator("div epipole-figure").first();
  await ready(figure);
  await expect(figure.locator(".root")).toHaveAttribute("data-theme", "dark");
  await other.close();
});

test("a state is restored exactly, whatever the attributes say", async ({ page, site }) => {
  const other = await elsewhere(site);
  await page.goto(other.origin);
  const figure = page.locator("epipole-figure");
  // At once, before the module is there.
  await figure.evaluate((element) => element.restore({ points: 40 }));
  expect((await told(figure)).state).toEqual({ points: "40" });
  await figure.evaluate((element) => element.apply({ points: 50, epsilon: 0.2 }));
  await figure.evaluate((element) => element.restore({ outliers: 0.3 }));
  await expect.poll(async () => (await told(figure)).state).toEqual({ outliers: "0.30" });
  await figure.evaluate((element) => element.restore({ points: "many" }));
  await expect(figure.locator(".notice")).toContainText('"many" is not a value of points');
  await other.close();
});

test("neither keys nor whoever holds a slider or a handle reach the page", async ({ page, site }) => {
  const other = await elsewhere(site);
  await page.goto(other.origin);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  await page.evaluate(() => {
    window.heard = [];
    for (const type of ["keydown", "keyup", "pointermove", "touchstart", "touchmove"]) {
      document.addEventListener(type, (event) => window.heard.push(`${type} ${event.key ?? ""}`));
    }
  });
  await figure.locator("input[type=range]").first().focus();
  for (const key of [" ", "ArrowRight", "a", "b", "Enter", "Home"]) await page.keyboard.press(key);
  const box = await figure.locator("input[type=range]").first().boundingBox();
  await page.mouse.move(box.x + box.width / 3, box.y + box.height / 2);
  await page.mouse.down();
  await page.evaluate(() => (window.heard = window.heard.filter((event) => !event.startsWith("pointer"))));
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 5 });
  await page.mouse.up();
  expect(await page.evaluate(() => window.heard)).toEqual([]);
  await page.keyboard.press("Escape");
  expect(await page.evaluate(() => document.activeElement.localName)).toBe("body");
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
