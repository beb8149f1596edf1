// The book without a network: its service worker keeps a visited chapter, then everything; offers a
// new edition; and is no obstacle where it is forbidden, has no room, or the book is being written.

import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, expectAccessible, ready, test } from "./fixtures.mjs";
import { book, root } from "./places.mjs";
import { BOOK_POLICY, serve, TYPES } from "./server.mjs";

test.skip(!book, "the book is not what is tested");
test.use({ serviceWorkers: "allow" });

/** Time to keep the whole book, milliseconds. */
const WHOLE_MS = 60_000;

/** Serves the book, with other content for the paths of `site.other`. */
async function library() {
  const site = { other: {}, redirects: false };
  const course = async (url, response) => {
    let path = decodeURIComponent(url.pathname.slice("/course/".length)) || "index.html";
    if (site.redirects && path.endsWith(".html")) {
      return void response.writeHead(308, { Location: `/course/${path.slice(0, -5)}` }).end();
    }
    if (site.redirects && !path.includes(".")) path += ".html";
    try {
      const bytes = site.other[path] ?? readFileSync(join(book, path));
      const type = TYPES[path.slice(path.lastIndexOf("."))] ?? "text/plain";
      response.writeHead(200, { "Content-Type": type, "Content-Security-Policy": BOOK_POLICY }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  };
  const { origin, close } = await serve({ mounts: { course, frame }, policy: "frame-src 'self'" });
  return Object.assign(site, { address: `${origin}/course`, origin, close });
}

const frame = () => `<!doctype html><iframe src="/course/rays.html"></iframe>`;

const text = (path) => readFileSync(join(book, path), "utf8");

const list = () => readdirSync(join(book, "assets")).find((name) => /^offline-.*\.json$/.test(name));

/** The files of a next edition, whose chapter of rays has another title. */
function nextEdition() {
  const first = list();
  const page = text("rays.html").replace(/<h1[^>]*>/, "$&Second edition: ");
  const told = JSON.parse(text(`assets/${first}`));
  told.integrity["rays.html"] = `sha256-${createHash("sha256").update(page).digest("base64")}`;
  const next = first.replace(/-.*\./, "-second.");
  return {
    "rays.html": page,
    [`assets/${next}`]: JSON.stringify(told),
    "sw.js": text("sw.js").replaceAll(first, next),
  };
}

const sign = (page) => page.getByText("Available offline");
const title = (page) => page.getByRole("heading", { level: 1 });
const notice = (page) => page.getByText("A new edition is available.");

/** Opens the first chapter and waits until the whole book is kept. */
async function visit(page, site) {
  await page.goto(`${site.address}/rays.html`);
  await expect(sign(page)).toBeVisible({ timeout: WHOLE_MS });
}

/** Pretends that the reader wants to save data. */
const saving = () => Object.defineProperty(navigator, "connection", { value: { saveData: true } });

/** Opens the first chapter for a reader who saves data, and waits until that is kept. */
async function visitSaving(page, site) {
  await page.addInitScript(saving);
  await page.goto(`${site.address}/rays.html`);
  const pictures = () =>
    page.evaluate(async () => {
      const editions = await Promise.all((await caches.keys()).map((name) => caches.open(name)));
      const held = await Promise.all(editions.map((cache) => cache.keys()));
      return held.flat().filter(({ url }) => /assets\/figures\//.test(url)).length;
    });
  const groups = JSON.parse(text(`assets/${list()}`)).pages["rays.html"];
  const wanted = groups.filter(([path]) => path.startsWith("assets/figures/")).length;
  await expect.poll(pictures, { timeout: WHOLE_MS }).toBe(wanted);
}

test("the whole book is read without a network after one visit", async ({ page }) => {
  const site = await library();
  await visit(page, site);
  await site.close();
  for (const chapter of ["rays", "epipolar"]) {
    await page.goto(`${site.address}/${chapter}.html`);
    await expect(title(page)).toBeVisible();
    await ready(page.locator("epipole-figure").first());
  }
  // Also on a page without figures.
  await page.goto(`${site.address}/references.html`);
  await expect(sign(page)).toBeVisible();
  await page.goto(`${site.address}/`);
  await expect(title(page)).toBeVisible();
  await page.locator(".search-button").click();
  await page.getByRole("searchbox").fill("epipole");
  await expect(page.locator(".search-results a").first()).toBeVisible();
});

test("a reader who saves data keeps the visited chapter only", async ({ page, complaints }) => {
  const site = await library();
  await visitSaving(page, site);
  await site.close();
  await page.goto(`${site.address}/rays.html?any=1`);
  await ready(page.locator("epipole-figure").first());
  expect(complaints.filter((text) => !/ERR_/.test(text))).toEqual([]);
  await expect(page.goto(`${site.address}/epipolar.html`)).rejects.toThrow(/ERR_/);
  complaints.length = 0;
});

test("a new edition is offered, and comes when the reader wants it", async ({ page, complaints }) => {
  const site = await library();
  await visit(page, site);
  site.other = nextEdition();
  await page.reload();
  await expect(notice(page)).toBeVisible({ timeout: WHOLE_MS });
  await expect(title(page)).not.toContainText("Second edition");
  const shift = page.evaluate(
    () =>
      new Promise((done) => {
        let sum = 0;
        const add = (list) => list.getEntries().forEach(({ value }) => (sum += value));
        new PerformanceObserver(add).observe({ type: "layout-shift", buffered: true });
        setTimeout(() => done(sum), 500);
      }),
  );
  expect(await shift).toBeLessThanOrEqual(0.01);
  expect(complaints).toEqual([]);
  await expectAccessible(page, { within: ".edition-notice" });
  // axe measures by inline styles, which the policy forbids.
  complaints.length = 0;
  await page.getByRole("button", { name: "Later" }).click();
  await expect(notice(page)).toHaveCount(0);
  // The next page offers it again.
  await page.goto(`${site.address}/epipolar.html`);
  await page.goto(`${site.address}/rays.html`);
  await expect(title(page)).not.toContainText("Second edition");
  await page.getByRole("button", { name: "Reload" }).click();
  await expect(title(page)).toContainText("Second edition");
  await expect(sign(page)).toBeVisible();
  await expect(notice(page)).toHaveCount(0);
  await site.close();
  await page.reload();
  await expect(title(page)).toContainText("Second edition");
});

test("with half a book kept, pages are those of the server", async ({ page }) => {
  const site = await library();
  await visitSaving(page, site);
  site.other = nextEdition();
  await page.reload();
  await expect(title(page)).toContainText("Second edition");
  await ready(page.locator("epipole-figure").first());
  await expect(notice(page)).toHaveCount(0);
  await site.close();
});

test("a host that hides the ends of addresses serves the book offline, too", async ({ page }) => {
  const site = await library();
  site.redirects = true;
  await visit(page, site);
  await site.close();
  for (const path of ["epipolar.html", "epipolar"]) {
    await page.goto(`${site.address}/${path}`);
    await expect(title(page)).toContainText("Epipolar");
  }
});

/** Code before that of the worker, which takes something from it. */
const OBSTACLES = {
  "storage is full": `Cache.prototype.put = async () => { throw new DOMException("", "QuotaExceededError"); };`,
  "storage is forbidden": `Object.defineProperty(self, "caches", { get() { throw new DOMException("", "SecurityError"); } });`,
  "the worker cannot start": "throw new Error();",
};

for (const [what, code] of Object.entries(OBSTACLES)) {
  test(`where ${what}, pages work as before`, async ({ page }) => {
    const site = await library();
    site.other["sw.js"] = code + text("sw.js");
    for (const chapter of ["rays", "epipolar"]) {
      await page.goto(`${site.address}/${chapter}.html`);
      await ready(page.locator("epipole-figure").first());
      await page.waitForTimeout(2000);
      await expect(sign(page)).toHaveCount(0);
    }
    await site.close();
  });
}

const FORBIDDEN = {
  "has no workers": () => delete Navigator.prototype.serviceWorker,
  "forbids workers": () => {
    ServiceWorkerContainer.prototype.register = async () => {
      throw new DOMException("", "SecurityError");
    };
  },
};

for (const [what, corrupt] of Object.entries(FORBIDDEN)) {
  test(`a browser that ${what} shows the book as before`, async ({ page }) => {
    const site = await library();
    await page.addInitScript(corrupt);
    await page.goto(`${site.address}/rays.html`);
    await ready(page.locator("epipole-figure").first());
    await page.waitForTimeout(2000);
    await expect(sign(page)).toHaveCount(0);
    await site.close();
  });
}

test("frames register no worker", async ({ page }) => {
  const site = await library();
  await page.goto(`${site.origin}/frame`);
  await expect(page.frameLocator("iframe").getByRole("heading", { level: 1 })).toBeVisible();
  await page.goto(`${site.address}/embed/ransac-race.html`);
  await ready(page.locator("epipole-figure"));
  await page.waitForTimeout(2000);
  const registered = () => navigator.serviceWorker.getRegistrations().then(({ length }) => length);
  expect(await page.evaluate(registered)).toBe(0);
  await site.close();
});

test("a book that is being written removes the worker of a published one", async ({ page }) => {
  const site = await library();
  await visit(page, site);
  const source = join(root, "web/offline/retire.ts");
  const draft = text("rays.html").replace(/<link rel="manifest"[^>]*>/, "").replace(/<h1[^>]*>/, "$&Draft: ");
  const retire = execFileSync(join(root, "web/node_modules/.bin/esbuild"), [source, "--bundle", "--format=iife"]);
  site.other = { "rays.html": draft, "sw.js": retire };
  await page.reload();
  await expect(title(page)).toContainText("Draft: ");
  const left = async () => [(await navigator.serviceWorker.getRegistrations()).length, await caches.keys()];
  await expect.poll(() => page.evaluate(left)).toEqual([0, []]);
  await site.close();
});

test("the book can be installed", async ({ page }) => {
  const site = await library();
  await page.goto(`${site.address}/rays.html`);
  const session = await page.context().newCDPSession(page);
  const { errors, data } = await session.send("Page.getAppManifest");
  expect(errors).toEqual([]);
  const { name, icons, start_url } = JSON.parse(data);
  expect([name, start_url]).toEqual(["Epipole", "index.html"]);
  for (const { src, sizes } of icons) {
    const width = await page.evaluate(async (address) => {
      const image = new Image();
      image.src = address;
      await image.decode();
      return image.naturalWidth;
    }, `${site.address}/${src}`);
    expect(sizes === "any" || sizes === `${width}x${width}`, src).toBe(true);
  }
  await site.close();
});
