// The published Lab: it solves the sample, reads and writes files, and assistive technology finds
// everything by role.

import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { inflateRawSync } from "node:zlib";
import { choose, expect, expectAccessible, file, press, read, said, solved, test } from "./lab.mjs";

test.describe.configure({ mode: "serial" });

/** Export of the sample. */
let exported;
/** The page with the model in it. */
let modelPage;

/** A file of a zip archive. */
function entry(archive, name) {
  const at = archive.indexOf(name) - 30;
  const method = archive.readUInt16LE(at + 8);
  const start = at + 30 + name.length + archive.readUInt16LE(at + 28);
  const content = archive.subarray(start, start + archive.readUInt32LE(at + 18));
  return method === 0 ? content : inflateRawSync(content);
}

/** Measures between two points or vertices of the page of a model that no control covers. */
async function measure(page) {
  const places = await page.evaluate(() => {
    const seen = [];
    const now = currentView();
    const all = showsSurface() ? surface.positions : positions;
    const step = 3 * Math.ceil(all.length / 60);
    for (let i = 0; i < all.length && seen.length < 2; i += step) {
      const ray = add(all.subarray(i, i + 3), now.eye, -1);
      const depth = dot(ray, now.forward);
      const u = (1 + (dot(ray, now.right) * now.focal[0]) / depth) * (canvas.clientWidth / 2);
      const v = (1 - (dot(ray, now.up) * now.focal[1]) / depth) * (canvas.clientHeight / 2);
      if (document.elementFromPoint(u, v) === canvas) seen.push([u, v]);
    }
    return seen;
  });
  for (const [u, v] of places) await page.mouse.click(u, v);
  await expect(page.locator("#help")).toHaveText(/^Distance [\d.e-]+ in units of the model$/);
}

test("the sample is solved, looked at in every step, and saved", async ({ lab }) => {
  await solved(lab);
  await expect(lab.locator("#notice")).toBeEmpty();

  await press(lab, "button", "Matches");
  await expect(said(lab)).toContainText("36 of 36 pairs share enough matches", { timeout: 60_000 });
  await press(lab, "button", "Two views");
  await expect(said(lab)).toContainText("A scene with depth, seen from two places");
  await press(lab, "button", "Features");
  await expect(said(lab)).toContainText(/table-1\.png: \d+ features/);

  await press(lab, "button", "Export");
  await expect(said(lab)).toContainText("Ready to save: 9 cameras");
  const [download] = await Promise.all([
    lab.waitForEvent("download"),
    press(lab, "button", "Save reconstruction.zip"),
  ]);
  expect(download.suggestedFilename()).toBe("reconstruction.zip");
  const bytes = await read(download);
  exported = bytes;
  expect(bytes.subarray(0, 2).toString()).toBe("PK");
  for (const name of ["sparse/0/cameras.txt", "sparse/0/points3D.txt", "points.ply", "images/table-9.png"]) {
    expect(bytes.includes(name), name).toBe(true);
  }
  modelPage = join(mkdtempSync(join(tmpdir(), "model-")), "model.html");
  writeFileSync(modelPage, entry(bytes, "model.html"));
});

test("the page in the export turns and measures the model without a network", async ({ blank: page }) => {
  const requests = [];
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(pathToFileURL(modelPage).href);
  expect(requests).toHaveLength(1);
  await expect(page).toHaveTitle(/^3-D model: 9 images, \d+ points$/);
  await expectAccessible(page);
  await measure(page);
  const before = await page.screenshot();
  await page.locator("canvas").press("ArrowLeft");
  await expect.poll(async () => (await page.screenshot()).equals(before)).toBe(false);
  await page.locator("#view").selectOption("3");
  await page.locator("canvas").press("Home");
  await expect(page.locator("#view")).toHaveValue("");
  await expect(page.locator("#help")).toHaveText(/^Drag to turn/);
});

test("the sample comes solved and light; what is left out is computed once somebody asks for it", async ({ blank: lab, library }) => {
  // The modules for computing are loaded on demand.
  const computing = [];
  lab.on("request", (request) => {
    if (/lab-vision-[^/]*\.wasm$/.test(request.url())) computing.push(request.url());
  });
  const sample = lab.waitForRequest(/sample-[^/]*\.bin$/);
  await lab.goto(`${library}/lab/index.html`);
  await solved(lab);
  // Photographs of the sample are rendered without them; everything else is precomputed.
  await press(lab, "button", "Export");
  await expect(said(lab)).toContainText("Ready to save: 9 cameras", { timeout: 60_000 });
  expect(computing, "nothing was left to compute").toEqual([]);
  const weigh = async (url) => (await (await fetch(url)).arrayBuffer()).byteLength;
  const weight = await lab.evaluate(weigh, (await sample).url());
  expect(weight).toBeGreaterThan(100_000);
  expect(weight, "light enough for a phone").toBeLessThan(1_000_000);
  // New settings need computed descriptors and matches.
  await press(lab, "button", "Matches");
  await press(lab, "checkbox", "Mutual nearest only");
  await expect(said(lab)).toContainText("36 of 36 pairs share enough matches", { timeout: 90_000 });
  expect(computing.length).toBeGreaterThan(0);
});

test("the sample is computed with the same result where it does not come solved", async ({ lab, library, complaints }) => {
  await solved(lab);
  const words = await said(lab).textContent();
  await lab.route(/sample-[^/]*\.bin$/, (route) => route.fulfill({ status: 404, body: "" }));
  await lab.goto(`${library}/lab/index.html`);
  await solved(lab);
  await expect(said(lab)).toHaveText(words);
  complaints.length = 0;
});

test("a project is saved from its menu, while the sample is still computed and again when it is solved", async ({ lab }) => {
  for (const wait of [() => {}, solved]) {
    await wait(lab);
    const [download] = await Promise.all([lab.waitForEvent("download", { timeout: 60_000 }), choose(lab, "button", "Save")]);
    expect(download.suggestedFilename()).toBe("project.zip");
    const bytes = await read(download);
    expect(bytes.subarray(0, 2).toString()).toBe("PK");
    expect(bytes.includes("project.json")).toBe(true);
    await expect(said(lab)).toContainText("project.zip is saved.");
  }
});

test("knobs recompute, and undo brings the result back at once", async ({ lab }) => {
  await solved(lab);
  await press(lab, "button", "Photographs");
  await press(lab, "checkbox", "Use this photograph");
  await expect(said(lab)).toContainText("table-1.png: left out by you");
  await press(lab, "button", "Reconstruction");
  await expect(said(lab)).toContainText("8 of 9 photographs have a camera", { timeout: 60_000 });
  // "At once" means without any request to a worker; frame times depend on the machine.
  await lab.evaluate(() => {
    window.asked = 0;
    const post = Worker.prototype.postMessage;
    Worker.prototype.postMessage = function (...message) {
      window.asked += 1;
      return post.apply(this, message);
    };
  });
  await press(lab, "button", "Undo");
  await expect(said(lab)).toContainText("9 of 9 photographs have a camera");
  expect(await lab.evaluate(() => window.asked)).toBe(0);
});

test("one's own files take the place of the sample; what is no photograph is told", async ({ lab }) => {
  await solved(lab);
  const folder = mkdtempSync(join(tmpdir(), "lab-"));
  const broken = join(folder, "broken.jpg");
  writeFileSync(broken, Buffer.from([0xff, 0xd8, 0xff, 0, 1, 2]));
  await lab.locator("#photographs").setInputFiles([broken]);
  await expect(said(lab)).toContainText("broken.jpg: cannot be read", { timeout: 30_000 });
  // One change, one step of undo.
  await press(lab, "button", "Undo");
  await press(lab, "button", "Reconstruction");
  await solved(lab);
});

test("the menu of the project closes with what assistive technology chooses, and opens again", async ({ lab }) => {
  await solved(lab);
  for (let round = 0; round < 3; round += 1) {
    await choose(lab, "button", "Remove all photographs");
    await expect(said(lab)).toContainText("No photographs yet");
    await press(lab, "button", "Undo");
    await expect(said(lab)).toContainText("9 photographs.");
  }
});

test("the mouse opens menus on the canvas, chooses, and opens them again", async ({ lab }) => {
  await solved(lab);
  const canvas = await lab.locator("#lab").boundingBox();
  const click = async (x, y) => {
    await lab.mouse.move(canvas.x + x, canvas.y + y);
    await lab.mouse.down();
    await lab.mouse.up();
  };
  const menu = (name) => lab.locator("#widgets").getByRole("button", { name, exact: true });
  const isOpen = (name) => menu(name).getAttribute("aria-expanded").then((value) => value === "true");
  /** Horizontal position of a menu in the bar; the buttons to its right are disabled. */
  const find = async (name, from) => {
    for (let x = from; x > 0; x -= 20) {
      await click(x, 20);
      // The page mirrors widgets with a delay.
      const opened = expect.poll(() => isOpen(name), { timeout: 1000 }).toBe(true);
      if (await opened.then(() => true, () => false)) return x;
    }
    throw new Error(`no menu ${name} in the bar`);
  };
  const x = await find("Project", 420);
  // The items appear a frame later.
  await expect(menu("Project")).toHaveAttribute("aria-controls", /./);
  const opened = await menu("Project").getAttribute("aria-controls");
  const items = await lab.evaluate((ids) => ids.split(" ").map((id) => document.getElementById(id).getAttribute("aria-label") ?? ""), opened);
  expect(items.slice(0, 3)).toEqual(["Open…", "Save", "Remove all photographs"]);
  await expectAccessible(lab);
  for (let round = 0; round < 2; round += 1) {
    // Its first item opens a file chooser.
    const [chooser] = await Promise.all([lab.waitForEvent("filechooser"), click(x, 52)]);
    expect(chooser.isMultiple()).toBe(false);
    await expect(menu("Project")).toHaveAttribute("aria-expanded", "false");
    await expect(lab.locator("#widgets").getByRole("button", { name: "Open…" })).toHaveCount(0);
    await click(x, 20);
    await expect(menu("Project")).toHaveAttribute("aria-expanded", "true");
  }
  // Clicking beside the menu closes it.
  await click(600, 400);
  await expect(menu("Project")).toHaveAttribute("aria-expanded", "false");
});

test("a link opens a step with its knobs, and tells what it does not know", async ({ lab, library }) => {
  await lab.goto(`${library}/lab/index.html?step=matches&ratio=0.7&color=red`);
  await expect(said(lab)).toContainText('The Lab knows no "color".', { timeout: 30_000 });
  await expect(said(lab)).toContainText("pairs share enough matches");
  await expect.poll(() => new URL(lab.url()).search).toBe("?step=matches&ratio=0.7");
  await press(lab, "button", "Two views");
  await expect.poll(() => new URL(lab.url()).search).toBe("?step=two-views&ratio=0.7");
});

test("the links of the book to the Lab name what there is", async ({ lab, library }) => {
  const links = new Set();
  for (const page of ["connections.html", "sfm.html", "index.html"]) {
    await lab.goto(`${library}/${page}`);
    for (const href of await lab.locator('a[href*="lab/index.html"]').evaluateAll((all) => all.map((a) => a.href))) {
      links.add(href);
    }
  }
  expect(links.size).toBeGreaterThan(3);
  for (const href of links) {
    await lab.goto(href);
    await expect(said(lab)).not.toBeEmpty({ timeout: 30_000 });
    await expect(said(lab)).not.toContainText("knows no");
    await expect(said(lab)).not.toContainText("has no value");
  }
});

test("a figure hands on the reader's photographs, its step and its knobs, and nothing stays behind", async ({ blank, library, complaints }) => {
  const databases = () => blank.evaluate(async () => (await indexedDB.databases()).map(({ name }) => name));
  await blank.goto(`${library}/sfm.html`);
  const figure = blank.locator('epipole-figure[name="two-view-sfm"]').first();
  await figure.evaluate(async (element) => {
    element.apply({ stage: "match", ratio: 0.7 });
    await element.whenReady();
  });
  const button = blank.getByRole("button", { name: /in the Lab$/ });
  await expect(button).toHaveCount(0);
  const first = file("one.png", 640, 480);
  await figure.locator("#photo-first").setInputFiles(first);
  await expect(button).toHaveText("Open your photograph in the Lab");
  await figure.locator("#photo-second").setInputFiles(file("two.png", 600, 450));
  await expect(button).toHaveText("Open your 2 photographs in the Lab");
  expect(complaints).toEqual([]);
  await expectAccessible(blank);
  // Axe tries inline styles, which the book's policy forbids.
  complaints.length = 0;
  // A reset figure has no photographs.
  await figure.evaluate((element) => element.reset());
  await expect(button).toHaveCount(0);
  await figure.evaluate((element) => element.apply({ stage: "match", ratio: 0.7 }));
  await figure.locator("#photo-first").setInputFiles(first);
  await figure.locator("#photo-second").setInputFiles(file("two.png", 600, 450));
  expect(await databases(), "nothing is put aside unasked").toEqual([]);

  // Without a Lab, nothing is stored.
  await blank.route(/lab\/index\.html/, (route) => route.fulfill({ contentType: "text/html", body: "not yet" }));
  await button.click();
  await expect(blank.locator(".to-lab")).toContainText("The Lab cannot be reached just now.");
  expect(await databases()).toEqual([]);
  await blank.unroute(/lab\/index\.html/);

  await button.click();
  await blank.waitForURL(/lab\/index\.html\?step=matches/, { timeout: 30_000 });
  await expect(said(blank)).toContainText("1 pair", { timeout: 60_000 });
  await expect.poll(() => new URL(blank.url()).search).toBe("?step=matches&ratio=0.7");
  await press(blank, "button", "Photographs");
  await expect(said(blank)).toContainText("2 photographs.");
  for (const name of ["one.png", "two.png"]) {
    await expect(blank.locator("#widgets").getByRole("button", { name: new RegExp(`^${name}:`) })).toHaveCount(1);
  }
  await expect.poll(databases).toEqual([]);
});

test("an empty project leads to a verdict, and the verdict to the next step", async ({ lab }) => {
  await solved(lab);
  await choose(lab, "button", "Remove all photographs");
  await expect(said(lab)).toContainText("No photographs yet");
  await expectAccessible(lab);
  await press(lab, "button", "A flat poster");
  await expect(said(lab)).toContainText("Focal length unsure: ", { timeout: 90_000 });
  await expect(lab.locator("#widgets").getByRole("button", { name: "Matches", exact: true })).toHaveAccessibleDescription(/^done/);
  await expectAccessible(lab);
  await press(lab, "button", "Calibrate the camera");
  await expect.poll(() => new URL(lab.url()).searchParams.get("step")).toBe("calibrate");
});

test("every step is explained by a figure of the book, which runs beside it", async ({ lab, library }) => {
  await solved(lab);
  const aside = lab.getByRole("complementary");
  for (const step of ["Photographs", "Calibrate", "Features", "Matches", "Two views", "Reconstruction", "Depth", "Measure", "Export"]) {
    await press(lab, "button", step);
    // The next frame shows the step and loads its figure.
    const name = step.toLowerCase().replace(" ", "-");
    await expect.poll(() => new URL(lab.url()).searchParams.get("step")).toBe(name);
    await press(lab, "button", "What is this?");
    await expect(aside).toBeVisible();
    const figure = aside.locator("epipole-figure");
    await expect(figure.locator("canvas").first()).toBeVisible({ timeout: 60_000 });
    // The link and the figure appear one after the other.
    await expect(async () => {
      const chapter = await aside.getByRole("link", { name: "Read the chapter" }).getAttribute("href");
      const text = await (await fetch(chapter)).text();
      const shown = await figure.getAttribute("name");
      expect(chapter.startsWith(library)).toBe(true);
      expect(text.includes(`<epipole-figure name="${shown}"`), `${chapter} has ${shown}`).toBe(true);
    }).toPass({ timeout: 15_000 });
  }
  await expectAccessible(lab);
  await lab.keyboard.press("Escape");
  await expect(aside).toBeHidden();
});

test("every pixel of a pair gets a depth, which becomes part of the files", async ({ lab }) => {
  await solved(lab);
  await press(lab, "button", "Depth");
  await expect(said(lab)).toContainText(/table-1\.png and table-2\.png: \d+% of \d+ pixels have a depth/, { timeout: 90_000 });
  await press(lab, "checkbox", "Add to cloud and export");
  await press(lab, "button", "Reconstruction");
  await press(lab, "button", "Export");
  await expect(said(lab)).toContainText("Dense depth of 1 pair.");
  const [download] = await Promise.all([
    lab.waitForEvent("download"),
    press(lab, "button", "Save reconstruction.zip"),
  ]);
  const bytes = await read(download);
  for (const name of ["dense.ply", "depth/table-1_table-2.pfm", "depth/table-1_table-2.png"]) {
    expect(bytes.includes(name), name).toBe(true);
  }
});

test("all views become points and a surface, which the page of the export shows", async ({ lab, library }) => {
  await lab.goto(`${library}/lab/index.html?step=depth&all-views-megapixels=0.05`);
  await press(lab, "button", "All views");
  await press(lab, "button", "Depth of all views");
  await expect(said(lab)).toContainText(/\d+ points from all views\./, { timeout: 90_000 });
  await press(lab, "radio", "surface");
  await press(lab, "button", "Export");
  await expect(said(lab)).toContainText(/\d+ points from all views\./);
  const [download] = await Promise.all([
    lab.waitForEvent("download"),
    press(lab, "button", "Save reconstruction.zip"),
  ]);
  const bytes = await read(download);
  for (const name of ["fused.ply", "mesh.ply"]) expect(bytes.includes(name), name).toBe(true);
  const path = join(mkdtempSync(join(tmpdir(), "surface-")), "model.html");
  writeFileSync(path, entry(bytes, "model.html"));
  const page = await lab.context().newPage();
  await page.goto(pathToFileURL(path).href);
  await expect(page).toHaveTitle(/^3-D model: 9 images, \d+ points, \d+ triangles$/);
  await expectAccessible(page);
  const withSurface = await page.screenshot();
  await page.locator("#show").selectOption("points");
  await expect.poll(async () => (await page.screenshot()).equals(withSurface)).toBe(false);
  await page.locator("#show").selectOption("surface");
  await measure(page);
  await page.close();
});

test("photographs of a board give a camera, which is saved and used", async ({ lab }) => {
  await solved(lab);
  await press(lab, "button", "Calibrate");
  await expect(said(lab)).toContainText("No photographs of a board yet");
  await press(lab, "button", "Open the sample");
  await expect(said(lab)).toContainText("The board was found in 9 of 10 photographs. Focal lengths 5", { timeout: 90_000 });
  await expect(said(lab)).toContainText("board-10.png: a grid of");
  const [download] = await Promise.all([
    lab.waitForEvent("download"),
    press(lab, "button", "Save camera.json"),
  ]);
  expect(download.suggestedFilename()).toBe("camera.json");
  const camera = JSON.parse((await read(download)).toString());
  expect(Math.abs(camera.k[0] - 520)).toBeLessThan(1);
  expect(camera.image).toEqual({ width: 640, height: 480 });
  await press(lab, "button", "Use for my photographs");
  await expect(said(lab)).toContainText("used for photographs of 640 × 480 pixels");
  await press(lab, "button", "Undo");
  await expect(said(lab)).not.toContainText("used for photographs");
  // Files chosen now are taken for photographs of a calibration board.
  const folder = mkdtempSync(join(tmpdir(), "lab-"));
  const broken = join(folder, "broken.jpg");
  writeFileSync(broken, Buffer.from([0xff, 0xd8, 0xff, 0, 1, 2]));
  await lab.locator("#photographs").setInputFiles([broken]);
  await expect(said(lab)).toContainText("found in 0 of 1 photograph", { timeout: 30_000 });
  await expect(said(lab)).toContainText("broken.jpg: cannot be read");
});

test("a video becomes photographs, and one that is none is told", async ({ lab }) => {
  await solved(lab);
  // Record in an idle page.
  const studio = await lab.context().newPage();
  const buffer = Buffer.from(await studio.evaluate(recorded), "base64");
  await studio.close();
  expect(buffer.length).toBeGreaterThan(10_000);
  await press(lab, "button", "Photographs");
  await lab.locator("#photographs").setInputFiles([{ name: "walk.webm", mimeType: "video/webm", buffer }]);
  await expect(said(lab)).toContainText("20 frames were taken from the video.", { timeout: 90_000 });
  await expect(said(lab)).toContainText("20 photographs.");
  const broken = { name: "broken.mp4", mimeType: "video/mp4", buffer: Buffer.from("no video") };
  await lab.locator("#photographs").setInputFiles([broken]);
  await expect(said(lab)).toContainText("broken.mp4 cannot be read as a video here", { timeout: 30_000 });
  await expect(said(lab)).toContainText("20 photographs.");
});

test("the camera takes photographs once it is allowed, and says so where it is not", async ({ lab }) => {
  await solved(lab);
  await press(lab, "button", "Photographs");
  await lab.evaluate(() => {
    const media = navigator.mediaDevices;
    window.allowed = media.getUserMedia.bind(media);
    media.getUserMedia = () => Promise.reject(new DOMException("no", "NotAllowedError"));
  });
  await press(lab, "button", "Take photographs…");
  await expect(said(lab)).toContainText("The camera was refused.", { timeout: 30_000 });
  await lab.evaluate(() => (navigator.mediaDevices.getUserMedia = window.allowed));
  await press(lab, "button", "Take photographs…");
  const dialog = lab.getByRole("dialog", { name: "Take photographs" });
  await expect(dialog).toBeVisible();
  for (const count of [1, 2]) {
    await expect.poll(() => lab.locator("#camera-picture").evaluate((video) => video.videoWidth)).toBeGreaterThan(0);
    await dialog.getByRole("button", { name: "Take a photograph" }).click();
    await expect(dialog.getByRole("status")).toHaveText(`${count} taken.`);
  }
  await expectAccessible(lab);
  await dialog.getByRole("button", { name: "Done" }).click();
  await expect(dialog).toBeHidden();
  await expect(said(lab)).toContainText("2 photographs.", { timeout: 30_000 });
});

/** Runs in the page: a base64 video of a moving pattern, recorded until the encoder has output. */
async function recorded() {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [320, 240];
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const recorder = new MediaRecorder(canvas.captureStream(30), { mimeType: "video/webm" });
  const chunks = [];
  let size = 0;
  recorder.ondataavailable = ({ data }) => {
    chunks.push(data);
    size += data.size;
  };
  const stopped = new Promise((resolve) => (recorder.onstop = resolve));
  recorder.start(200);
  const begun = performance.now();
  for (let time = 0; time < 2000 || (size < 100_000 && time < 20_000); time = performance.now() - begun) {
    for (let n = 0; n < 300; n += 1) {
      context.fillStyle = `hsl(${(n * 47) % 360} 60% ${20 + ((n * 31) % 60)}%)`;
      context.fillRect((n * 71 + time / 20) % 320, (n * 37) % 240, 24, 18);
    }
    await new Promise((resolve) => setTimeout(resolve, 30));
  }
  recorder.stop();
  await stopped;
  const bytes = new Uint8Array(await new Blob(chunks).arrayBuffer());
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

test("Escape and Tab leave the canvas, and axe finds nothing wrong", async ({ lab }) => {
  await solved(lab);
  await lab.locator("#lab").focus();
  await lab.keyboard.press("Tab");
  await expect(lab.getByRole("link", { name: "Epipole" })).not.toBeFocused();
  await lab.keyboard.press("Escape");
  await lab.keyboard.press("Shift+Tab");
  await expect(lab.getByRole("link", { name: "Epipole" })).toBeFocused();
  await expectAccessible(lab);
  await lab.emulateMedia({ colorScheme: "dark" });
  await expectAccessible(lab);
});

test("work that is stopped ends by itself, before its worker is ended", async ({ blank, library }) => {
  await blank.addInitScript(() => {
    window.heard = [];
    window.Worker = class extends Worker {
      constructor(...how) {
        super(...how);
        this.addEventListener("message", ({ data }) => window.heard.push(data.problem ?? Object.keys(data).pop()));
      }
      // As slow as Chromium's own: the worker must stop by itself.
      terminate() {}
    };
  });
  await blank.goto(`${library}/lab/index.html`);
  await solved(blank);
  await blank.locator("#photographs").setInputFiles([file("one.png", 1800, 1400), file("two.png", 1900, 1400)]);
  await press(blank, "button", "Features");
  await expect(blank.locator("#widgets").getByRole("button", { name: "Stop", exact: true })).toHaveCount(1);
  // Reading reports progress too rarely to test a stop; finding features takes long enough.
  await expect(blank.locator("#widgets")).toContainText("Finding features in", { timeout: 60_000 });
  await blank.evaluate(() => (window.heard = []));
  await blank.waitForFunction(() => window.heard.includes("words"));
  await press(blank, "button", "Stop");
  await blank.waitForFunction(() => window.heard.includes("stopped"));
  await expect(said(blank)).toContainText("Computation is stopped.");
});

test("on an emulated screen nothing is larger than on a real one", async ({ blank, library }) => {
  const context = await blank.context().browser().newContext({ viewport: { width: 390, height: 844 }, deviceScaleFactor: 2 });
  const page = await context.newPage();
  await page.goto(`${library}/lab/index.html`);
  await solved(page);
  const sizes = await page.evaluate(() => {
    const { width, height, clientWidth, clientHeight } = document.querySelector("#lab");
    return [width / clientWidth, height / clientHeight];
  });
  // Heights may be fractions of pixels.
  for (const size of sizes) expect(size).toBeCloseTo(2, 2);
  await context.close();
});

test("photographs dropped onto the picture are added, and a text among them is named", async ({ lab }) => {
  await solved(lab);
  const files = [file("one.png", 64, 48), file("two.png", 80, 60)].map(({ name, buffer }) => [name, buffer.toString("base64")]);
  const transfer = await lab.evaluateHandle((files) => {
    const transfer = new DataTransfer();
    for (const [name, text] of files) {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      transfer.items.add(new File([bytes], name, { type: "image/png" }));
    }
    transfer.items.add(new File(["f = 700"], "notes.txt", { type: "text/plain" }));
    return transfer;
  }, files);
  for (const kind of ["dragenter", "dragover", "drop"]) {
    await lab.locator("#lab").dispatchEvent(kind, { dataTransfer: transfer });
  }
  await expect(said(lab)).toContainText("2 photographs.", { timeout: 30_000 });
  await expect(said(lab)).toContainText("notes.txt: neither a photograph nor a camera file");
});

test("cameras of another program are taken for its photographs, and given up", async ({ lab }) => {
  await solved(lab);
  const files = (folder, names) => names.map((name) => ({ name, mimeType: "", buffer: entry(exported, `${folder}/${name}`) }));
  await lab.locator("#photographs").setInputFiles(files("images", ["table-1.png", "table-2.png", "table-3.png"]));
  await expect(said(lab)).toContainText("3 photographs.", { timeout: 30_000 });
  await press(lab, "button", "Reconstruction");
  await lab.locator("#camera-files").setInputFiles(files("sparse/0", ["cameras.txt", "images.txt"]));
  await expect(said(lab)).toContainText(/3 of 3 photographs have a camera.*Cameras of 3 of 3 photographs come from cameras.txt/, { timeout: 90_000 });
  await press(lab, "button", "Find the cameras instead");
  await expect(said(lab)).not.toContainText("come from cameras.txt");
});

test("a page with unsaved photographs asks before it closes", async ({ lab }) => {
  await solved(lab);
  const asks = () =>
    lab.evaluate(() => !dispatchEvent(new Event("beforeunload", { cancelable: true })));
  expect(await asks(), "the sample is nobody's work").toBe(false);
  await lab.locator("#photographs").setInputFiles([file("one.png", 64, 48), file("two.png", 80, 60)]);
  await expect(said(lab)).toContainText("2 photographs.", { timeout: 30_000 });
  expect(await asks()).toBe(true);
  await Promise.all([lab.waitForEvent("download"), choose(lab, "button", "Save")]);
  await expect(said(lab)).toContainText("project.zip is saved.");
  expect(await asks()).toBe(false);
});
