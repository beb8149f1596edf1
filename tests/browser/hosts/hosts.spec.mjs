// Figures in third-party sites: each host's own tool builds our recipe, and the figure is operated.

import { execFile, spawn } from "node:child_process";
import { cpSync, mkdirSync, readdirSync, readFileSync, rmSync, statSync, symlinkSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { promisify } from "node:util";
import { deflateRawSync } from "node:zlib";
import { unzipSync } from "../../../web/node_modules/fflate/esm/index.mjs";
import { elements, here, root } from "../places.mjs";
import { serve } from "../server.mjs";
import { expect, figures, test as base } from "../fixtures.mjs";
import { answers, follows, operate } from "./drive.mjs";
import { folderOf, work } from "./recipes.mjs";
import { endServers, fileServer, freePort, started } from "./serving.mjs";

const run = promisify(execFile);
const tools = join(here, "hosts/node_modules");
const python = join(work, "python/bin");

const test = base.extend({
  /** The book's server, on another origin than the course. */
  book: [
    async ({}, use) => {
      const server = await serve({ mounts: { embed: join(elements, "embed"), assets: join(elements, "assets") }, policy: false });
      await use(server.origin);
      await server.close();
    },
    { scope: "worker" },
  ],

  context: async ({ browser }, use) => {
    const context = await browser.newContext({ viewport: { width: 1200, height: 900 }, hasTouch: true });
    await use(context);
    await context.close();
  },

  /** Requests to origins that the test does not name. */
  strangers: async ({ page, book }, use) => {
    const known = [book];
    const strange = [];
    page.on("request", (request) => {
      const { protocol, origin } = new URL(request.url());
      if (/^(https?|wss?):$/.test(protocol) && !known.includes(origin)) strange.push(request.url());
    });
    await use(known);
    expect(strange, "requests elsewhere").toEqual([]);
  },
});

test.afterEach(endServers);

/** Runs a tool in a folder. */
const tool = (folder, command, ...args) => toolIn({}, folder, command, ...args);

/** Runs a tool with environment variables. Expects no warnings that mention the figures. */
async function toolIn(env, folder, command, ...args) {
  const { stdout, stderr } = await run(command, args, { cwd: folder, env: { ...process.env, NO_COLOR: "1", ...env }, maxBuffer: 1 << 26 });
  const ours = `${stdout}\n${stderr}`.split("\n").filter((line) => /warn/i.test(line) && /epipole/i.test(line));
  expect(ours, "warnings about the figures").toEqual([]);
}

const npx = (name) => join(tools, ".bin", name);

const dark = (page) => ({
  darken: () => page.evaluate(() => (document.body.style.background = "#101014")),
  lighten: () => page.evaluate(() => (document.body.style.background = "#ffffff")),
});

async function visit(page, address, strangers) {
  strangers.push(new URL(address).origin);
  await page.goto(address);
}

const race = (page) => page.locator('epipole-figure[name="ransac-race"]');
const map = (page) => page.locator('epipole-figure[name="disparity-map"]');

/** Installs the package as npm would. */
function withPackage(folder) {
  const home = join(folder, "node_modules/@epipole");
  mkdirSync(home, { recursive: true });
  cpSync(join(work, "package"), join(home, "figures"), { recursive: true });
  for (const name of ["@rollup"]) symlinkSync(join(tools, name), join(folder, "node_modules", name));
}

const copyFiles = (folder) =>
  tool(folder, "sh", "-c", "cp node_modules/@epipole/figures/dist/*.wasm node_modules/@epipole/figures/dist/worker.js dist/");

/** Bytes that the files of a folder take in a wheel. */
function wheelBytes(folder) {
  const entries = readdirSync(folder, { recursive: true, withFileTypes: true });
  const files = entries.filter((entry) => entry.isFile());
  return files.reduce((sum, { parentPath, name }) => sum + deflateRawSync(readFileSync(join(parentPath, name))).length, 0);
}

test("the packages are small, and say rightly what is in them", async () => {
  const packed = join(work, readdirSync(work).find((file) => file.endsWith(".tgz")));
  const modules = join(root, "crates/epipole-python/python");
  const [files, glue] = ["epipole_figures", "epipole/figures/glue.js"].map((path) => join(modules, path));
  const bytes = { npm: statSync(packed).size, wheel: wheelBytes(files), _esm: statSync(glue).size };
  test.info().annotations.push({ type: "bytes", description: JSON.stringify(bytes) });
  // Per figure, since they grow with the figures.
  expect(bytes.npm / figures.length).toBeLessThanOrEqual(30_500);
  expect(bytes.wheel / figures.length).toBeLessThanOrEqual(36_500);
  expect(bytes._esm).toBeLessThanOrEqual(75_000);
  await tool(work, npx("publint"), "run", packed, "--strict");
  // Older module resolution and CommonJS are unsupported: the package is for browsers and bundlers.
  await tool(work, npx("attw"), packed, "--profile", "esm-only", "--no-color", "--no-emoji");
});

test("viewers without widgets", async ({ page, strangers }) => {
  const tests = join(root, "crates/epipole-python/tests/test_figures.py");
  await tool(root, join(python, "python"), "-m", "pytest", "--quiet", "--noconftest", tests);
  // A notebook executed without a viewer, then exported.
  const folder = join(work, "made/viewers");
  mkdirSync(folder, { recursive: true });
  const cell = (source) => ({ cell_type: "code", id: `cell-${source.length}`, metadata: {}, execution_count: null, outputs: [], source });
  const cells = ["from epipole.figures import Figure\nFigure('ransac-race')", "Figure('ransac-race', outliers=0.4)"].map(cell);
  const metadata = { kernelspec: { name: "python3", display_name: "Python 3", language: "python" } };
  writeFileSync(join(folder, "figures.ipynb"), JSON.stringify({ cells, metadata, nbformat: 4, nbformat_minor: 5 }));
  const settings = ["--execute", "--ExecutePreprocessor.store_widget_state=False", "--to", "html", "--template", "basic", "figures.ipynb"];
  await toolIn({ PATH: `${python}:${process.env.PATH}` }, folder, join(python, "jupyter"), "nbconvert", ...settings);
  const server = await fileServer(folder);
  await visit(page, `${server.origin}/figures.html`, strangers);
  const pictures = page.getByRole("img");
  await expect(pictures).toHaveCount(2);
  await expect(pictures.first()).toHaveAttribute("alt", /^Interactive figure ransac-race\. /);
  await expect(pictures.last()).toHaveAttribute("alt", /^Interactive figure ransac-race, outliers=0\.4\. At its defaults: /);
  for (const picture of await pictures.all()) {
    const wide = await picture.evaluate(async (image) => (await image.decode(), image.naturalWidth));
    expect(wide).toBeGreaterThan(300);
  }
  await server.close();
});

const bundlers = {
  vite: async (folder) => (await tool(folder, npx("vite"), "build"), join(folder, "dist")),
  webpack: async (folder) => (await tool(folder, npx("webpack"), "--mode", "production", "--entry", "./main.js"), folder),
  rollup: async (folder) => (await tool(folder, npx("rollup"), "-c"), await copyFiles(folder), folder),
  esbuild: async (folder) => (await tool(folder, npx("esbuild"), "main.js", "--bundle", "--format=esm", "--outdir=dist"), await copyFiles(folder), folder),
  parcel: async (folder) => (await tool(folder, npx("parcel"), "build", "index.html", "--cache-dir", join(folder, ".cache")), join(folder, "dist")),
};

for (const [name, build] of Object.entries(bundlers)) {
  test(name, async ({ page, book, strangers }) => {
    const folder = folderOf(name, book);
    withPackage(folder);
    const server = await fileServer(await build(folder));
    await visit(page, `${server.origin}/index.html`, strangers);
    await operate(page, race(page));
    await answers(map(page));
    const { darken, lighten } = dark(page);
    await follows(race(page), darken, lighten);
    await server.close();
  });
}

test("vite, while one writes", async ({ page, book, strangers }) => {
  const folder = folderOf("vite", book);
  withPackage(folder);
  const server = await started(spawn(npx("vite"), ["--port", "0", "--host", "127.0.0.1"], { cwd: folder, env: { ...process.env, NO_COLOR: "1" } }), /(http:\/\/127\.0\.0\.1:\d+)/);
  strangers.push(server.origin.replace("http", "ws"));
  await visit(page, server.origin, strangers);
  await operate(page, race(page));
  await answers(map(page));
  await page.goto("about:blank");
  await server.close();
});

test("reveal.js", async ({ page, book, strangers }) => {
  const folder = folderOf("reveal", book);
  cpSync(join(tools, "reveal.js/dist"), join(folder, "dist"), { recursive: true });
  const server = await fileServer(folder);
  await visit(page, `${server.origin}/index.html`, strangers);
  await operate(page, race(page));
  const inside = await race(page).evaluate((element) => {
    const [slide, box] = [document.querySelector(".slides"), element].map((part) => part.getBoundingClientRect());
    return box.top >= slide.top - 1 && box.bottom <= slide.bottom + 1;
  });
  expect(inside, "the figure is on the slide").toBe(true);
  await page.evaluate(() => window.Reveal.next());
  await answers(map(page));
  await page.evaluate(() => window.Reveal.prev());
  const { darken, lighten } = dark(page);
  await follows(race(page), darken, lighten);
  await server.close();
});

test("MkDocs Material", async ({ page, book, strangers }) => {
  const folder = folderOf("mkdocs", book);
  await tool(folder, join(python, "mkdocs"), "build", "--quiet", "--strict");
  const server = await fileServer(join(folder, "site"));
  await visit(page, `${server.origin}/`, strangers);
  await operate(page, race(page));
  const choose = (scheme) => () => page.evaluate((name) => document.body.setAttribute("data-md-color-scheme", name), scheme);
  await follows(race(page), choose("slate"), choose("default"));
  await page.getByRole("link", { name: "stereo", exact: true }).click();
  await answers(map(page));
  await page.getByRole("link", { name: "fitting", exact: true }).click();
  await operate(page, race(page));
  await server.close();
});

test("Sphinx with MyST", async ({ page, book, strangers }) => {
  const folder = folderOf("sphinx", book);
  await tool(folder, join(python, "sphinx-build"), "-q", "-W", "-b", "html", ".", "_build");
  const server = await fileServer(join(folder, "_build"));
  await visit(page, `${server.origin}/index.html`, strangers);
  await operate(page, race(page));
  // The attribute by which its themes switch.
  const choose = (theme) => () => page.evaluate((name) => (document.documentElement.dataset.theme = name), theme);
  await follows(race(page), choose("dark"), choose("light"));
  await page.goto(`${server.origin}/stereo.html`);
  await answers(map(page));
  await server.close();
});

// Generators that leave the design to authors, with their output folders.
const generators = {
  hugo: async (folder) => (await tool(folder, join(python, "hugo"), "--quiet", "--panicOnWarning"), join(folder, "public")),
  jekyll: async (folder) => (await tool(folder, "jekyll", "build", "--quiet", "--disable-disk-cache"), join(folder, "_site")),
};

for (const [name, build] of Object.entries(generators)) {
  test(name, async ({ page, book, strangers }) => {
    const folder = folderOf(name, book);
    const server = await fileServer(await build(folder));
    await visit(page, `${server.origin}/`, strangers);
    await operate(page, race(page));
    const { darken, lighten } = dark(page);
    await follows(race(page), darken, lighten);
    await page.getByRole("link", { name: "stereo", exact: true }).click();
    await answers(map(page));
    await server.close();
  });
}

test("MyST", async ({ page, book, strangers }) => {
  const folder = folderOf("myst", book);
  // Its own themes are downloaded; this one uses the same package for widgets.
  const config = join(folder, "myst.yml");
  writeFileSync(config, readFileSync(config, "utf8").replace("book-theme", "theme"));
  mkdirSync(join(folder, "theme"));
  writeFileSync(join(folder, "theme/template.yml"), "myst: v1\nkind: site\ntitle: Plain\nversion: 1.0.0\nfiles: []\n");
  await tool(folder, npx("myst"), "build", "--site");
  const site = join(folder, "_build/site");
  cpSync(join(site, "content"), join(site, "public/content"), { recursive: true });
  await tool(folder, npx("esbuild"), join(here, "hosts/myst.jsx"), "--bundle", "--format=esm", "--jsx=automatic", `--outfile=${join(site, "public/show.js")}`);
  for (const slug of ["index", "stereo"]) {
    writeFileSync(
      join(site, `public/${slug}.html`),
      `<!doctype html><html lang="en"><title>${slug}</title><style>.dark body { background: #1c1917; color: #fff }</style>
      <main></main><script type="module" src="show.js"></script></html>`,
    );
  }
  const server = await fileServer(join(site, "public"));
  const asked = [];
  page.on("request", (request) => asked.push(new URL(request.url()).origin));
  await visit(page, `${server.origin}/index.html`, strangers);
  await operate(page, race(page));
  const choose = (isDark) => () => page.evaluate((on) => document.documentElement.classList.toggle("dark", on), isDark);
  await follows(race(page), choose(true), choose(false));
  await page.evaluate(() => globalThis.leave());
  await expect(race(page)).toHaveCount(0);
  expect(asked, "the widget is part of the site").not.toContain(book);
  await page.goto(`${server.origin}/stereo.html`);
  await answers(map(page.frameLocator("iframe")));
  await server.close();
});

test("PreTeXt", async ({ page, book, strangers }) => {
  const folder = folderOf("pretext", book);
  const project = join(folder, "project.ptx");
  const offline = '<target name="web" format="html"><stringparams debug.rs.dev="yes"/></target>';
  writeFileSync(project, readFileSync(project, "utf8").replace('<target name="web" format="html"/>', offline));
  mkdirSync(join(folder, "home"));
  // It unpacks itself into HOME. Without npm on the PATH, it uses the built styles that it ships.
  await toolIn({ HOME: join(folder, "home"), PATH: python }, folder, join(python, "pretext"), "build", "web");
  const site = join(folder, "output/web");
  // Requests of its own pages, and files that such a build expects of Runestone: all stubbed.
  const theirs = ["https://cdn.jsdelivr.net", "https://fonts.googleapis.com", "https://fonts.gstatic.com"];
  await page.route(({ origin }) => theirs.includes(origin), (route) => route.fulfill({ body: "" }));
  const server = await fileServer(site);
  await page.route(`${server.origin}/_static/prefix-*`, (route) => route.fulfill({ body: "" }));
  strangers.push(...theirs);
  await visit(page, `${server.origin}/fitting.html`, strangers);
  const figure = race(page.frameLocator("iframe"));
  await operate(page, figure);
  // Its pages follow the system, as the iframe does.
  const choose = (colorScheme) => () => page.emulateMedia({ colorScheme });
  await follows(figure, choose("dark"), choose("light"));
  await page.goto(`${server.origin}/stereo.html`);
  await answers(map(page.frameLocator("iframe")));
  await server.close();
});

test("mdBook", async ({ page, book, strangers }) => {
  const folder = folderOf("mdbook", book);
  await tool(root, "cargo", "run", "--locked", "--quiet", "--example", "mdbook", "--", folder);
  const server = await fileServer(join(folder, "book"));
  await visit(page, `${server.origin}/fitting.html`, strangers);
  await operate(page, race(page));
  const choose = (theme) => async () => {
    await page.locator("#mdbook-theme-toggle, #theme-toggle").first().click();
    await page.getByRole("menuitem", { name: theme, exact: true }).click();
    await page.keyboard.press("Escape");
  };
  await choose("Light")();
  await follows(race(page), choose("Coal"), choose("Light"));
  await page.keyboard.press("ArrowRight");
  await page.waitForURL(/stereo\.html/);
  await answers(map(page));
  await server.close();
});

test("Docusaurus", async ({ page, book, strangers }) => {
  test.slow(true, "it builds its pages for the browser and for the server");
  const folder = folderOf("docusaurus", book);
  const modules = join(folder, "node_modules");
  mkdirSync(modules, { recursive: true });
  for (const name of readdirSync(tools)) if (!name.startsWith(".")) symlinkSync(join(tools, name), join(modules, name));
  mkdirSync(join(modules, "@epipole"));
  cpSync(join(work, "package"), join(modules, "@epipole/figures"), { recursive: true });
  await tool(folder, npx("docusaurus"), "build");
  const server = await fileServer(join(folder, "build"), "/course/");
  await visit(page, `${server.origin}/course/`, strangers);
  await operate(page, race(page));
  const choose = (theme) => () => page.evaluate((name) => (document.documentElement.dataset.theme = name), theme);
  await choose("light")();
  await follows(race(page), choose("dark"), choose("light"));
  // Navigation without a page load.
  await page.getByRole("main").getByRole("link", { name: "stereo", exact: true }).click();
  await answers(map(page));
  await page.getByRole("main").getByRole("link", { name: "fitting", exact: true }).click();
  await operate(page, race(page));
  await server.close();
});

test("JupyterLab", async ({ page, book, strangers }) => {
  const folder = folderOf("jupyter", book);
  const child = spawn(join(python, "jupyter"), ["lab", "--no-browser", "--allow-root", "--ip=127.0.0.1", "--port=0", "--ServerApp.port_retries=0", "--IdentityProvider.token=t", "--LabApp.news_url=", "--LabApp.expose_app_in_browser=True", "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate", `--ServerApp.root_dir=${folder}`], {
    cwd: folder,
    env: { ...process.env, PATH: `${python}:${process.env.PATH}`, JUPYTER_CONFIG_DIR: join(folder, ".config"), JUPYTER_DATA_DIR: join(folder, ".data"), JUPYTER_RUNTIME_DIR: join(folder, ".runtime") },
  });
  const server = await started(child, /(http:\/\/127\.0\.0\.1:\d+)\/lab\?token=/);
  strangers.push(server.origin.replace("http", "ws"));
  await visit(page, `${server.origin}/lab/tree/figures.ipynb?token=t`, strangers);
  const cells = page.locator(".jp-Notebook .jp-CodeCell");
  // Cells run before the kernel is connected are lost.
  await expect(page.getByRole("button", { name: /\| Idle$/ })).toBeVisible({ timeout: 90_000 });
  await cells.first().locator(".cm-content").click();
  for (let cell = 0; cell < 2; cell += 1) await page.keyboard.press("Shift+Enter");
  await operate(page, race(page));
  // As its settings menu does, without the delay of clicking.
  const wear = (theme) => async () => {
    // Wait for its splash screen to be gone, as removing it twice raises an error.
    await expect(page.locator("#jupyterlab-splash")).toHaveCount(0);
    await page.evaluate((name) => window.jupyterapp.commands.execute("apputils:change-theme", { theme: name }), theme);
  };
  // Load each theme once, so that the timing below excludes the host's loading.
  for (const theme of ["JupyterLab Dark", "JupyterLab Light"]) {
    await wear(theme)();
    // Requests during the loading of a theme are lost.
    await expect.poll(() => page.evaluate(() => document.body.dataset.jpThemeName), { timeout: 30_000 }).toBe(theme);
  }
  await expect(page.locator("#jupyterlab-splash")).toHaveCount(0);
  await follows(race(page), wear("JupyterLab Dark"), wear("JupyterLab Light"));
  await answers(map(page));
  await expect(cells).toHaveCount(3);
  // State set by the reader is visible in Python, and vice versa.
  const type = async (words) => {
    await cells.last().locator(".cm-content").click();
    await page.keyboard.type(words);
    await page.keyboard.press("Shift+Enter");
  };
  const state = () => race(page).evaluate((element) => (element.flush(), element.state));
  const asPython = (now) => JSON.stringify(Object.fromEntries(Object.entries(now).sort())).replaceAll(":", ": ").replaceAll('","', '", "');
  const now = await state();
  await type("import json; print(json.dumps(race.state, sort_keys=True), len(race.readouts) > 3)");
  await expect(page.locator(".jp-OutputArea-output pre").last()).toHaveText(`${asPython(now)} True\n`);
  await type("race.state = {'outliers': 0.3, 'points': 40}; race.press('step')");
  await expect.poll(state).toMatchObject({ outliers: "0.30", points: "40", iterations: expect.any(String) });
  const stepped = asPython(await state());
  await expect
    .poll(
      async () => {
        await type("print(json.dumps(race.state, sort_keys=True))");
        return page.locator(".jp-OutputArea-output pre").last().textContent();
      },
      { timeout: 60_000, intervals: [1000] },
    )
    .toBe(`${stepped}\n`);
  // A new figure of the same state gives the same readouts.
  await type("Figure('ransac-race', **race.state)");
  const both = page.locator('epipole-figure[name="ransac-race"]');
  await expect(both).toHaveCount(2);
  await expect(both.last()).toHaveAttribute("data-ready", "", { timeout: 60_000 });
  const told = (index) => both.nth(index).evaluate((element) => (element.flush(), [element.state, element.readouts]));
  expect(await told(1)).toEqual(await told(0));
  // Static viewers get the current picture as PNG once the figure has settled.
  await expect
    .poll(
      async () => {
        await type("import base64; data, _ = race._repr_mimebundle_(); shown = base64.b64decode(data['image/png']); print(shown == race.picture, shown[1:4])");
        return page.locator(".jp-OutputArea-output pre").last().textContent();
      },
      { timeout: 60_000, intervals: [2000] },
    )
    .toBe("True b'PNG'\n");
  const modules = await page.evaluate(() => performance.getEntriesByType("resource").filter(({ name }) => name.endsWith(".wasm")).length);
  expect(modules, "modules come through the kernel").toBe(0);
  // Leave the page first, so that it requests nothing from the closing server.
  await page.goto("about:blank");
  await server.close();
});

test("marimo", async ({ page, book, strangers }) => {
  const folder = folderOf("marimo", book);
  // Apps may follow the reader's system.
  writeFileSync(join(folder, "pyproject.toml"), '[tool.marimo.display]\ntheme = "system"\n');
  const child = spawn(join(python, "marimo"), ["run", "course.py", "--headless", "--no-token", "--host", "127.0.0.1", "--port", String(await freePort())], {
    cwd: folder,
    env: { ...process.env, MARIMO_SKIP_UPDATE_CHECK: "1" },
  });
  const server = await started(child, /(http:\/\/(?:127\.0\.0\.1|localhost):\d+)/);
  strangers.push(server.origin.replace("http", "ws"));
  await visit(page, server.origin, strangers);
  await operate(page, race(page));
  const system = (colorScheme) => () => page.emulateMedia({ colorScheme });
  await follows(race(page), system("dark"), system("light"));
  await answers(map(page));
  // Leave the page first, so that it requests nothing from the closing server.
  await page.goto("about:blank");
  await server.close();
});

test("a plain script; and a second copy, which leaves everything to the first", async ({ page, book, strangers }) => {
  const folder = join(work, "made/plain");
  rmSync(folder, { recursive: true, force: true });
  cpSync(join(work, "package/dist"), join(folder, "scripts"), { recursive: true });
  const figures = ["ransac-race", "disparity-map"].map((name) => `<epipole-figure name="${name}"></epipole-figure>`);
  const second = `<script type="module" src="${book}/embed/epipole.js"></script>`;
  writeFileSync(join(folder, "index.html"), `<!doctype html><title>Course</title><script src="scripts/auto.js"></script>${figures.join("")}${second}`);
  const server = await fileServer(folder);
  const said = [];
  page.on("console", (message) => message.type() === "warning" && said.push(message.text()));
  await visit(page, `${server.origin}/index.html`, strangers);
  await operate(page, race(page));
  await answers(map(page));
  expect(said).toEqual(["epipole-figure: another copy of the figures is on this page already, and serves it"]);
  await server.close();
});

/**
 * Serves a learning platform with a SCORM package that `command` makes: a player that stores values
 * between visits.
 */
async function platform(name, ...command) {
  const folder = join(work, "made", name);
  rmSync(folder, { recursive: true, force: true });
  const zip = join(folder, "package.zip");
  mkdirSync(folder, { recursive: true });
  await tool(folder, "node", ...command, "--out", zip, "--title", "Who is <right>?");
  const files = unzipSync(readFileSync(zip));
  for (const [name, bytes] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, "package", name)), { recursive: true });
    writeFileSync(join(folder, "package", name), bytes);
  }
  const listed = [...new TextDecoder().decode(files["imsmanifest.xml"]).matchAll(/<file href="([^"]+)"/g)].map(([, name]) => name);
  expect([...listed, "imsmanifest.xml"].sort()).toEqual(Object.keys(files).sort());
  cpSync(join(tools, "scorm-again/dist/scorm12.min.js"), join(folder, "scorm12.js"));
  writeFileSync(
    join(folder, "index.html"),
    `<!doctype html><html lang="en"><title>A course</title><script src="scorm12.js"></script>
    <script>
      window.visit = (kept) => {
        document.querySelector("iframe")?.remove();
        window.API = new window.Scorm12API({ autocommit: false, logLevel: 5 });
        if (kept) window.API.loadFromJSON(kept.cmi ?? kept);
        const frame = document.createElement("iframe");
        Object.assign(frame, { src: "package/index.html", width: 1000, height: 800 });
        document.body.append(frame);
      };
      addEventListener("DOMContentLoaded", () => window.visit());
    </script><body></body>`,
  );
  return fileServer(folder);
}

const kept = (page, name) => page.evaluate((key) => window.API.lmsGetValue(key), name);

/** Leaves the package and comes back to it. */
async function visitAgain(page) {
  const cmi = await page.evaluate(() => JSON.parse(JSON.stringify(window.API.renderCMIToJSONObject?.() ?? window.API.renderCMIToJSON())));
  await page.evaluate((data) => window.visit(data), cmi);
}

test("SCORM 1.2", async ({ page, strangers }) => {
  const server = await platform("scorm", join(root, "web/scorm/figure.mjs"), "ransac-race", "seed=3");
  await visit(page, `${server.origin}/`, strangers);
  const figure = page.frameLocator("iframe").locator("epipole-figure");
  await expect(figure).toHaveAttribute("data-ready", "");
  await figure.getByRole("slider", { name: "Outlier ratio" }).press("Home");
  await expect.poll(async () => Number(await kept(page, "cmi.core.score.raw"))).toBeGreaterThan(0);
  expect(await kept(page, "cmi.core.lesson_status")).toBe("incomplete");
  await figure.evaluate((element) => (element.points = 34, element.flush()));
  await expect.poll(() => kept(page, "cmi.suspend_data")).toContain('"points":"34"');
  const before = await figure.evaluate((element) => element.saved);
  await visitAgain(page);
  await expect(figure).toHaveAttribute("data-ready", "");
  await expect.poll(() => figure.evaluate((element) => element.saved)).toEqual(before);
  await server.close();
});

test("SCORM 1.2 of a chapter", async ({ page, strangers }) => {
  const server = await platform("scorm-chapter", join(root, "web/scorm/chapter.mjs"), "rays");
  await visit(page, `${server.origin}/`, strangers);
  const chapter = page.frameLocator("iframe").frameLocator("iframe");
  await expect(chapter.locator("epipole-figure").first()).toHaveAttribute("data-ready", "");
  // Of another page, only the words are there.
  expect(await chapter.locator("a[href*='.html']:not([href^='rays.html'])").count()).toBe(0);
  const form = chapter.locator(".quiz form").filter({ has: chapter.locator("input[data-answer]") }).first();
  const input = form.locator("input[data-answer]");
  await input.fill(await input.getAttribute("data-answer"));
  await form.getByRole("button", { name: "Check" }).click();
  await expect.poll(async () => Number(await kept(page, "cmi.core.score.raw"))).toBeGreaterThan(0);
  expect(await kept(page, "cmi.core.lesson_status")).toBe("incomplete");
  const data = await kept(page, "cmi.suspend_data");
  // The state that the platform keeps is enough.
  await chapter.locator("html").evaluate(() => localStorage.clear());
  await visitAgain(page);
  await expect(form.locator(".verdict")).toHaveText("You solved this one.");
  expect(await kept(page, "cmi.suspend_data")).toBe(data);
  await server.close();
});
