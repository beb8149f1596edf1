// Faults of servers, pages and browsers: each shows a message with a way to retry, and never raises
// an uncaught error. Retrying works afterwards.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, ready, settled, test, told } from "./fixtures.mjs";
import { figurePage, made } from "./pages.mjs";
import { book, elements, here, jobsWasm, loadBindings, script, wasm } from "./places.mjs";
import { POLICY, serve, TYPES } from "./server.mjs";

const { Figure, compute } = await loadBindings();
/** A figure that needs the worker, since it only shows results of a long computation. */
const name = "bundle-adjustment";
const worker = /(?:^|\/)worker[^/]*\.js$/;

/** Expected final state of the figure. */
const right = (() => {
  const figure = new Figure(name);
  for (let key = figure.job_key(); key !== undefined; key = figure.job_key()) {
    figure.job_done(key, compute(name, figure.job_request(), { progress: () => {} }));
  }
  const { readouts } = JSON.parse(figure.snapshot(760));
  return Object.fromEntries(readouts.map(({ id, value }) => [id, value]));
})();

const send = (type) => (response, bytes) => response.writeHead(200, { "Content-Type": type }).end(bytes);
const half = (bytes) => bytes.subarray(0, bytes.length / 2);
const other = (path) => readFileSync(join(elements, path));

/** Faults of a server when sending a file: `(response, bytes, type)`. */
const FAULTS = {
  missing: (response) => response.writeHead(404).end(),
  "not for everyone": (response) => response.writeHead(403, { "Content-Type": "text/html" }).end("<h1>Forbidden</h1>"),
  "cut off": (response, bytes, type) => {
    response.writeHead(200, { "Content-Type": type, "Content-Length": bytes.length });
    response.write(half(bytes), () => response.destroy());
  },
  "half of it": (response, bytes, type) => send(type)(response, half(bytes)),
  "nothing in it": (response, bytes, type) => send(type)(response, ""),
  corrupt: (response, bytes, type) => {
    const broken = Buffer.from(bytes);
    broken.fill(0xff, bytes.length / 3, bytes.length / 3 + 64);
    send(type)(response, broken);
  },
  "a page to sign in": (response) => send("text/html")(response, "<!doctype html><title>Sign in</title>"),
  "never answered": () => {},
  "never ended": (response, bytes, type) => response.writeHead(200, { "Content-Type": type }).write(half(bytes)),
};

/** Serves a site with `site.faults`, pairs `[pattern, fault]`; `asked` counts requests. */
async function faulty() {
  const site = { faults: [], asked: 0 };
  const files = (folder) => async (url, response) => {
    const path = decodeURIComponent(url.pathname.split("/").slice(2).join("/"));
    const type = TYPES[path.slice(path.lastIndexOf("."))] ?? "text/plain";
    const [, fault] = site.faults.find(([pattern]) => pattern.test(path)) ?? [];
    if (fault) site.asked += 1;
    let bytes;
    try {
      bytes = readFileSync(join(folder, path));
    } catch {
      response.writeHead(404).end();
      return;
    }
    response.setHeader("Content-Security-Policy", POLICY);
    (fault ?? send(type))(response, bytes, type);
  };
  const pages = { figures: figurePage, made, pages: join(here, "pages") };
  const server = await serve({ mounts: { ...pages, elements: files(elements), book: files(book ?? elements) } });
  return Object.assign(site, server);
}

/** Shortens the time limit of 15 s to 0.7 s. */
function hurry(page) {
  return page.addInitScript(() => {
    const real = window.setTimeout;
    window.setTimeout = (work, delay, ...more) => real(work, delay === 15_000 ? 700 : delay, ...more);
  });
}

/** Ignores the browser's own errors for failed requests; errors of our scripts remain. */
function forgive(complaints) {
  const rest = complaints.filter((text) => !/^Failed to load resource|^Failed to load module script/.test(text));
  complaints.splice(0, complaints.length, ...rest);
}

test("whatever comes in place of a module, the figure says so, and the next attempt counts", async ({ page, complaints }) => {
  const site = await faulty();
  await hurry(page);
  const renamed = (bytes) => Buffer.from(bytes.toString("latin1").replace("figure_take_focal", "figure_take_vocal"), "latin1");
  const table = [
    ...Object.entries(FAULTS).map(([what, fault]) => [what, fault, /^never/.test(what) ? /is slow to come/ : /could not be loaded/]),
    ["the other module", (response) => send("application/wasm")(response, other(jobsWasm)), /another version/],
    ["an empty module", (response) => send("application/wasm")(response, Buffer.from("AGFzbQEAAAA=", "base64")), /another version/],
    ["one function has another name", (response, bytes) => send("application/wasm")(response, renamed(bytes)), /another version/],
  ];
  site.faults = [[/epipole-figures.*\.wasm$/, table[0][1]]];
  await page.goto(`${site.origin}/figures?figure=${name}`);
  const figure = page.locator("epipole-figure");
  const notice = figure.locator(".notice");
  for (const [index, [what, , says]] of table.entries()) {
    await test.step(what, async () => {
      await expect.poll(() => site.asked, { message: what, intervals: [50] }).toBe(index + 1);
      await expect(notice).toContainText(says);
      await expect(figure.locator("[aria-live]")).toContainText(says);
      await expect(page.getByRole("img", { name: `Poster of ${name}` })).toBeVisible();
      await expect(figure.locator("canvas")).toBeHidden();
      const next = table[index + 1];
      site.faults = next ? [[/epipole-figures.*\.wasm$/, next[1]]] : [];
      await figure.getByRole("button", { name: "Try again" }).click();
    });
  }
  await ready(figure);
  await settled(figure);
  await expect(notice).toBeHidden();
  expect((await told(figure)).readouts).toEqual(right);
  forgive(complaints);
  await site.close();
});

test("whatever comes in place of a long computation, the figure says so, and Reset tries again", async ({ page, complaints }) => {
  const site = await faulty();
  await hurry(page);
  const table = [];
  for (const [file, pattern] of [["worker", worker], ["module", /epipole-jobs.*\.wasm$/]]) {
    for (const [what, fault] of Object.entries(FAULTS)) {
      // An empty worker answers nothing, like one that never loads.
      const silent = /^never/.test(what) || (file === "worker" && what === "nothing in it");
      table.push([`${file}: ${what}`, pattern, fault, silent]);
    }
  }
  table.push(["module: the other", /epipole-jobs.*\.wasm$/, (response) => send("application/wasm")(response, other(wasm)), false]);
  const [, pattern, fault] = table[0];
  site.faults = [[pattern, fault]];
  await page.goto(`${site.origin}/figures?figure=${name}`);
  const figure = page.locator("epipole-figure");
  const job = figure.locator(".job");
  await ready(figure);
  let before = 0;
  for (const [index, [what, , , silent]] of table.entries()) {
    await test.step(what, async () => {
      const [, pattern, fault] = table[index + 1] ?? [];
      const next = () => (site.faults = pattern ? [[pattern, fault]] : []);
      await expect.poll(() => site.asked, { message: what, intervals: [50] }).toBeGreaterThan(before);
      before = site.asked;
      if (silent) {
        await expect(job).toContainText("the code for it is slow to come");
        next();
        await job.getByRole("button", { name: "Try again" }).click();
      } else {
        await figure.evaluate((element) => element.flush());
        await expect(figure.locator(".description")).toContainText(/(could not be loaded|another version).*Reset tries again/);
        await expect(job).toBeHidden();
        next();
        await figure.getByRole("button", { name: "Reset", exact: true }).click();
      }
    });
  }
  await settled(figure);
  expect((await told(figure)).readouts).toEqual(right);
  forgive(complaints);
  await site.close();
});

/**
 * Restrictive pages: `policy` and `head` precede the figure, which runs or shows the message
 * `says`.
 */
const PAGES = {
  "nothing is forbidden": {},
  "a strict policy": { policy: POLICY },
  "a policy without WebAssembly": { policy: POLICY.replace(" 'wasm-unsafe-eval'", ""), says: /needs WebAssembly, which this browser or this page does not allow/ },
  "a policy without workers": { policy: `${POLICY}; worker-src 'none'` },
  "a policy with Trusted Types": { policy: `${POLICY}; require-trusted-types-for 'script'; trusted-types 'none'` },
  "a frame in a sandbox": { sandbox: "allow-scripts" },
  "no WebAssembly": { head: "delete globalThis.WebAssembly", says: /needs WebAssembly/ },
  "no workers": { head: "delete globalThis.Worker" },
  "no modules while they arrive": { head: "delete WebAssembly.compileStreaming; delete WebAssembly.instantiateStreaming" },
  "no storage": {
    head: "for (const kind of ['localStorage', 'indexedDB', 'caches']) Object.defineProperty(globalThis, kind, { get() { throw new DOMException('no', 'SecurityError') } })",
  },
};

test("on pages that forbid things a figure runs all the same, or says why not", async ({ page, complaints }) => {
  const keys = Object.keys(PAGES);
  const inside = async (url, response) => {
    const index = Number(url.searchParams.get("page"));
    const { policy, head = "" } = PAGES[keys[index]];
    if (policy) response.setHeader("Content-Security-Policy", policy);
    response.setHeader("Content-Type", TYPES[".html"]);
    const prepare = head && `<script src="/heads?page=${index}"></script>`;
    const figure = `<script type="module" src="/elements/${script}"></script><epipole-figure name="${name}"><img src="/pages/poster.svg" alt="Poster"></epipole-figure>`;
    response.end(`<!doctype html><html lang="en"><title>${keys[index]}</title>${prepare}${figure}`);
  };
  const heads = (url, response) => {
    response.writeHead(200, { "Content-Type": TYPES[".js"] }).end(PAGES[keys[Number(url.searchParams.get("page"))]].head);
  };
  const outside = () =>
    `<!doctype html><html lang="en"><title>Frames</title><style>iframe { width: 480px; height: 400px }</style>${keys
      .map((key, index) => `<iframe src="/inside?page=${index}" title="${key}" ${PAGES[key].sandbox ? `sandbox="${PAGES[key].sandbox}"` : ""}></iframe>`)
      .join("")}`;
  const site = await serve({ mounts: { "": outside, inside, heads, elements, pages: join(here, "pages") }, policy: false });
  const workers = [];
  page.on("worker", (found) => workers.push(found.url()));
  await page.goto(site.origin);
  for (const [index, [key, { says }]] of Object.entries(PAGES).entries()) {
    await test.step(key, async () => {
      const frame = page.frameLocator("iframe").nth(index);
      const figure = frame.locator("epipole-figure");
      await page.locator("iframe").nth(index).scrollIntoViewIfNeeded();
      if (says) {
        await expect(figure.locator(".notice")).toContainText(says);
        await expect(figure.getByRole("button", { name: "Try again" })).toBeVisible();
        await expect(frame.getByRole("img", { name: "Poster" })).toBeVisible();
        return;
      }
      await expect(figure).toHaveAttribute("data-ready", "");
      await settled(figure);
      expect((await told(figure)).readouts, key).toEqual(right);
      await expect(figure.locator(".notice")).toBeHidden();
    });
  }
  // All other pages use a worker, also in a sandbox, so that they stay responsive.
  const without = keys.filter((key) => PAGES[key].says || /without workers|Trusted|no workers/.test(key)).length;
  expect(workers.length).toBe(keys.length - without);
  // The browser logs policy violations; any other error is ours.
  const ours = complaints.filter((text) => !/Content Security Policy|TrustedScriptURL|WebAssembly.*unsafe-eval/.test(text));
  expect(ours).toEqual([]);
  complaints.length = 0;
  await site.close();
});

test("isolated from other origins, and frozen while it computes, a figure comes to its end", async ({ page, context }) => {
  const isolated = {
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Embedder-Policy": "require-corp",
  };
  const mounts = { figures: figurePage, made, elements, pages: join(here, "pages") };
  const site = await serve({ mounts, more: isolated });
  let release;
  const released = new Promise((resolve) => (release = resolve));
  await page.route(/epipole-jobs.*\.wasm$/, async (route) => {
    await released;
    await route.continue();
  });
  await page.goto(`${site.origin}/figures?figure=${name}`);
  expect(await page.evaluate(() => crossOriginIsolated)).toBe(true);
  const figure = page.locator("epipole-figure");
  await ready(figure);
  await expect(figure.locator(".job")).toBeVisible();
  const devtools = await context.newCDPSession(page);
  await devtools.send("Page.setWebLifecycleState", { state: "frozen" });
  release();
  await new Promise((resolve) => setTimeout(resolve, 1500));
  await devtools.send("Page.setWebLifecycleState", { state: "active" });
  await settled(figure);
  expect((await told(figure)).readouts).toEqual(right);
  await expect(figure.locator(".notice")).toBeHidden();
  await site.close();
});
