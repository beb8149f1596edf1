// A third-party page embeds a figure with a script tag alone.

import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { expect, followed, plain, ready, test, told } from "./fixtures.mjs";
import { book, here, script } from "./places.mjs";
import { serve } from "./server.mjs";

const name = plain;

/** Serves the page as a teacher would write it, with the address of the book. */
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
  // The reader has to reach a goal, not the page.
  await expect(page.locator("#heard")).not.toContainText("epipole-challenge");
  for (const key of ["End", "Home"]) await figure.getByRole("slider", { name: "Outlier ratio" }).press(key);
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

test("a figure in a frame that comes into view moves the frame's page, and not the one around it", async ({ page, site }) => {
  const other = await elsewhere(site);
  const frame = `<iframe src="${other.origin}/" width="900" height="500"></iframe>`;
  const outer = await serve({
    mounts: { "": () => `<!doctype html><title>A course</title><p style="height: 600px">Text</p>${frame}<p style="height: 3000px">` },
    policy: false,
  });
  await page.goto(outer.origin);
  const figure = page.frameLocator("iframe").locator("epipole-figure");
  await figure.evaluate((element) => customElements.whenDefined(element.localName));
  await figure.evaluate((element) => element.glide({ points: 40 }));
  expect((await told(figure)).state.points).toBe("40");
  expect(await page.frames()[1].evaluate(() => scrollY)).toBeGreaterThan(1000);
  expect(await page.evaluate(() => scrollY)).toBe(0);
  await other.close();
  await outer.close();
});

test("a page's own switch of colors is followed, and so is a style sheet that comes later", async ({ page, site }) => {
  const other = await elsewhere(site);
  await page.goto(other.origin);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  await expect(figure.locator(".root")).toHaveAttribute("data-theme", "light");
  const took = [];
  const change = async (theme, work) => took.push(await followed(figure, theme, () => page.evaluate(work)));
  // As site generators do: an attribute of their own on the body, and color transitions.
  await change("dark", () => {
    const sheet = document.createElement("style");
    sheet.textContent = `
      body { background: #fff; transition: background 250ms }
      [data-md-color-scheme="slate"] { background: #1e2129 }`;
    document.head.append(sheet);
    document.body.setAttribute("data-md-color-scheme", "slate");
  });
  await change("light", () => document.body.removeAttribute("data-md-color-scheme"));
  await change("dark", () => {
    const sheet = document.createElement("style");
    sheet.textContent = "body { background: #000; transition: none }";
    document.head.append(sheet);
  });
  // The median, as load may delay one of them.
  expect(took.sort((a, b) => a - b)[1], `milliseconds: ${took}`).toBeLessThanOrEqual(1000);
  // A slow transition: the figure follows once the page is light.
  await followed(figure, "light", () =>
    page.evaluate(() => {
      document.body.style.transition = "background 1500ms steps(1, jump-end)";
      document.body.style.background = "#fff";
    }),
  );
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
  // Called before the module has loaded.
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
  const slider = figure.locator("input[type=range]").first();
  await slider.focus();
  for (const key of [" ", "ArrowRight", "a", "b", "Enter", "Home"]) await page.keyboard.press(key);
  // Hover waits until the slider is stable, as the key presses may have moved it.
  await slider.hover();
  await page.mouse.down();
  const box = await slider.boundingBox();
  expect(await slider.evaluate((input) => input.matches(":active"))).toBe(true);
  await page.evaluate(() => (window.heard = window.heard.filter((event) => !event.startsWith("pointer"))));
  await page.mouse.move(box.x + box.width / 3, box.y + box.height / 2, { steps: 5 });
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

test("one version can be asked for, with the hashes of its scripts", async ({ page, library, complaints }) => {
  const versions = readdirSync(join(book, "embed"), { withFileTypes: true }).filter((entry) => entry.isDirectory());
  expect(versions).toHaveLength(1);
  const folder = `${library}/embed/${versions[0].name}`;
  const { version, integrity } = await (await page.request.get(`${folder}/integrity.json`)).json();
  expect(folder.endsWith(`/embed/${version}`)).toBe(true);
  const scripts = Object.fromEntries(
    Object.entries(integrity)
      .filter(([path]) => path.endsWith(".js"))
      .map(([path, hash]) => [`${library}/${path}`, hash]),
  );
  const entry = `${folder}/epipole.js`;
  expect(Object.keys(scripts)).toContain(entry);
  const pageOf = (hashes) => `<!doctype html><title>A course</title>
<script type="importmap">${JSON.stringify({ integrity: hashes })}</script>
<script type="module" src="${entry}" integrity="${hashes[entry]}" crossorigin="anonymous"></script>
<epipole-figure name="${name}"></epipole-figure>`;
  let hashes = scripts;
  const other = await serve({ mounts: { "": () => pageOf(hashes) }, policy: false });
  await page.goto(other.origin);
  await ready(page.locator("epipole-figure"));
  // A script with another hash is not run.
  const elements = Object.keys(scripts).find((path) => /\/index-/.test(path));
  hashes = { ...scripts, [elements]: scripts[entry] };
  expect(complaints).toEqual([]);
  await page.goto(other.origin);
  await expect.poll(() => complaints.join()).toContain("integrity");
  expect(await page.evaluate(() => customElements.get("epipole-figure"))).toBe(undefined);
  complaints.length = 0;
  await other.close();
});

test("the widget needs no kernel and no other file", async ({ page }) => {
  const html = `<!doctype html><title>Notes</title><div id="here"></div><script type="module">
import widget from "/embed/widget.js";
// The least that a page which shows anywidgets has for them.
const state = { name: "ransac-race", state: { points: "20" } };
const hears = new EventTarget();
const model = {
  get: (key) => state[key],
  set(key, value) { state[key] = value; hears.dispatchEvent(new Event("change:" + key)); },
  save_changes() {},
  on: (type, heard) => hears.addEventListener(type, heard),
  off: (type, heard) => hears.removeEventListener(type, heard),
};
globalThis.model = model;
globalThis.leave = await widget.render({ model, el: document.querySelector("#here") });
</script>`;
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  const other = await serve({ mounts: { embed: join(book, "embed"), "": () => html }, policy: false });
  await page.goto(other.origin);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  await expect.poll(() => page.evaluate(() => Object.keys(globalThis.model.get("readouts") ?? {}).length)).toBeGreaterThan(0);
  expect((await told(figure)).state).toEqual({ points: "20" });
  await page.evaluate(() => globalThis.model.set("state", { points: "30" }));
  await expect.poll(async () => (await told(figure)).state).toEqual({ points: "30" });
  await figure.evaluate((element) => element.apply({ points: 40 }));
  await expect.poll(() => page.evaluate(() => globalThis.model.get("state"))).toEqual({ points: "40" });
  await page.evaluate(() => globalThis.leave());
  await expect(figure).toHaveCount(0);
  expect(asked.filter((url) => !url.startsWith("blob:"))).toEqual([`${other.origin}/`, `${other.origin}/embed/widget.js`]);
  await other.close();
});
