// Behavior of elements that only some figures have, and browser settings of readers.

import { expect, figures, first, gripOf, hear, heard, plain, ready, test, told } from "./fixtures.mjs";

const running = first(
  ({ controls }) => controls.some(({ role }) => role === "run") && controls.some(({ id }) => id === "outliers"),
);
const removable = first(({ handles }) => handles.some((handle) => handle.removable));
const clickable = first(({ layout }) => layout.panels.some((panel) => panel.clickable));
const crowded = first(({ handles }) => handles.length > 12);
const patient = first(({ waiting }) => waiting !== null);
const own = first(({ photos }) => photos.length > 0);
const name = plain;

test("there is a figure of every kind", () => {
  for (const found of [running, removable, clickable, crowded, patient, own]) expect(found).toBeTruthy();
});

test("Run animates, Pause pauses, and out of sight everything stands still", async ({ page, open }) => {
  const figure = await open(page, [`${running} outliers=0.8`]);
  await hear(figure, "epipole-readout");
  const run = figure.locator("button.run");
  await run.click();
  await expect(run).toHaveText("Pause");
  await expect.poll(async () => (await heard(figure)).length).toBeGreaterThan(2);
  await page.evaluate(() => {
    document.body.style.paddingBottom = "5000px";
    scrollTo(0, 4000);
  });
  await expect(figure).not.toBeInViewport();
  await page.waitForTimeout(300);
  const count = (await heard(figure)).length;
  await page.waitForTimeout(700);
  expect((await heard(figure)).length).toBe(count);
  await page.evaluate(() => scrollTo(0, 0));
  await expect.poll(async () => (await heard(figure)).length).toBeGreaterThan(count);
  await run.click();
  await expect(run).not.toHaveText("Pause");
});

test("a reader who wants no motion gets few steps instead of many frames", async ({ page, open }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  const figure = await open(page, [`${running} outliers=0.8`]);
  await figure.evaluate((element) => {
    element.frames = [];
    const canvas = element.shadowRoot.querySelector("canvas");
    const real = CanvasRenderingContext2D.prototype.putImageData;
    CanvasRenderingContext2D.prototype.putImageData = function (...args) {
      // Redrawing the same picture is no motion. Use the frame's own time, independent of the load.
      if (this.canvas === canvas) {
        const pixels = new Uint32Array(args[0].data.slice().buffer);
        const picture = pixels.reduce((sum, pixel) => (Math.imul(sum, 31) + pixel) | 0, 0);
        if (picture !== element.picture) element.frames.push(document.timeline.currentTime);
        element.picture = picture;
      }
      return real.apply(this, args);
    };
  });
  await figure.locator("button.run").click();
  await expect.poll(() => figure.evaluate((element) => element.frames.length)).toBeGreaterThan(4);
  const frames = await figure.evaluate((element) => element.frames);
  // The first frame shows the pressed button; after it, at most two frames per second.
  const gaps = frames.slice(2).map((time, index) => time - frames[index + 1]);
  expect(Math.min(...gaps)).toBeGreaterThan(500);
});

test("Delete removes a point, and the keys stay in the figure", async ({ page, open }) => {
  const figure = await open(page, [removable]);
  const { grip } = await gripOf(figure);
  await grip.focus();
  const id = await grip.getAttribute("data-handle");
  await page.keyboard.press("Delete");
  await expect(figure.locator(`[data-handle="${id}"]`)).toHaveCount(0);
  const focused = await figure.evaluate((element) => element.shadowRoot.activeElement?.className);
  expect(focused).toMatch(/grip|crosshair/);
});

test("keys and mouse add what a click adds", async ({ page, open }) => {
  const figure = await open(page, [clickable]);
  await hear(figure, "epipole-change");
  const crosshair = figure.locator(".crosshair").first();
  await crosshair.focus();
  for (const key of ["ArrowLeft", "ArrowLeft", "ArrowUp", "ArrowUp", "ArrowUp"]) await page.keyboard.press(key);
  await page.keyboard.press("Enter");
  await expect.poll(async () => (await heard(figure)).length).toBeGreaterThan(0);
  await figure.getByRole("button", { name: "Reset", exact: true }).click();
  expect((await told(figure)).state).toEqual({});

  // The same position by mouse; the new point can be dragged right away.
  await figure.locator("canvas").scrollIntoViewIfNeeded();
  const box = await crosshair.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  const clicked = await told(figure);
  expect(clicked.state).not.toEqual({});
  await page.mouse.move(x + 25, y + 15, { steps: 3 });
  await page.mouse.up();
  expect((await told(figure)).state).not.toEqual(clicked.state);
});

test("many points share one focus stop and a list", async ({ page, open }) => {
  const figure = await open(page, [crowded]);
  await expect(figure.locator(".grip")).toHaveCount(1);
  const list = figure.getByLabel("Point for the arrow keys");
  const options = await list.locator("option").evaluateAll((all) => all.map(({ value }) => value));
  expect(options.length).toBeGreaterThan(12);
  await list.focus();
  await expect(list).toBeVisible();
  await list.selectOption(options[5]);
  await page.keyboard.press("Tab");
  const focused = await figure.evaluate((element) => element.shadowRoot.activeElement.dataset.handle);
  expect(focused).toBe(options[5]);
});

test("colors follow the page as it changes, and the reader's wish for contrast", async ({ page, open }) => {
  const figure = await open(page, [name], { query: { theme: "light" } });
  const root = figure.locator(".root");
  const corner = () =>
    figure.locator("canvas").evaluate((canvas) => canvas.getContext("2d").getImageData(1, 1, 1, 1).data[0]);
  expect(await corner()).toBeGreaterThan(200);
  await page.evaluate(() => (document.documentElement.dataset.theme = "dark"));
  await expect(root).toHaveAttribute("data-theme", "dark");
  await expect.poll(corner).toBeLessThan(60);
  await page.evaluate(() => delete document.documentElement.dataset.theme);
  await expect(root).toHaveAttribute("data-theme", "light");
  await page.emulateMedia({ colorScheme: "dark" });
  await expect(root).toHaveAttribute("data-theme", "dark");
  await page.emulateMedia({ contrast: "more" });
  await expect(root).toHaveAttribute("data-theme", "high-contrast");
  await expect.poll(corner).toBe(0);
});

test("print shows picture, words and caption, and nothing to press", async ({ page, open }) => {
  const figure = await open(page, [name]);
  const { description } = await told(figure);
  await page.emulateMedia({ media: "print" });
  await expect(figure.locator("canvas")).toBeVisible();
  await expect(figure.locator(".description")).toHaveText(description);
  await expect(figure.locator(".description")).toBeVisible();
  await expect(page.getByText(`Caption of ${name}.`)).toBeVisible();
  for (const hidden of [".head", ".controls", ".challenges"]) {
    await expect(figure.locator(hidden)).toBeHidden();
  }
});

test("a long computation runs in a worker, tells its progress, and can be stopped", async ({ page, open }) => {
  // Hold back the worker's script to observe the figure meanwhile.
  let release;
  const released = new Promise((resolve) => (release = resolve));
  await page.route(/worker[^/]*\.js$/, async (route) => {
    await released;
    await route.continue();
  });
  const figure = await open(page, [patient], { settle: false });
  const job = figure.locator(".job");
  await expect(job).toBeVisible();
  await expect(job.locator("progress")).toBeVisible();
  const waiting = await told(figure);
  await job.getByRole("button", { name: "Stop" }).click();
  await expect(job).toContainText("stopped");
  release();
  await job.getByRole("button", { name: "Go on" }).click();
  await expect(job).toBeHidden();
  await expect.poll(async () => (await told(figure)).readouts).not.toEqual(waiting.readouts);
  expect(page.workers().length).toBe(1);
});

test("a photograph of one's own is taken, made smaller, and goes nowhere", async ({ page, open }) => {
  const figure = await open(page, [own]);
  const sent = [];
  page.on("request", (request) => request.method() !== "GET" && sent.push(request.url()));
  const url = await page.evaluate(() => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [3000, 2000];
    const context = canvas.getContext("2d");
    context.fillStyle = "#dddddd";
    context.fillRect(0, 0, 3000, 2000);
    context.fillStyle = "#224466";
    context.fillRect(700, 500, 900, 800);
    return canvas.toDataURL("image/png");
  });
  const before = await told(figure);
  await figure.locator("input[type=file]").first().setInputFiles({
    name: "kitchen.png",
    mimeType: "image/png",
    buffer: Buffer.from(url.split(",")[1], "base64"),
  });
  await expect(figure.locator(".photo .note").first()).toContainText("Made smaller, from 3000 × 2000");
  await expect(figure.locator(".photo .note").first()).toContainText("Stays on your device");
  await expect.poll(async () => (await told(figure)).readouts).not.toEqual(before.readouts);
  expect(sent).toEqual([]);

  await figure.locator("input[type=file]").first().setInputFiles({
    name: "letter.txt",
    mimeType: "text/plain",
    buffer: Buffer.from("no picture"),
  });
  await expect(figure.locator(".notice")).toContainText("letter.txt is not a photograph");
});

test("what is transparent in a photograph is black, from top to bottom", async ({ page, open }) => {
  const seen = [];
  for (const ground of ["transparent", "black"]) {
    const url = await page.evaluate((ground) => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [1600, 2000];
      const context = canvas.getContext("2d");
      context.fillStyle = ground;
      context.fillRect(0, 0, 1600, 2000);
      context.fillStyle = "#dd8844";
      for (let row = 0; row < 9; row += 1) context.fillRect(100 + 130 * row, 60 + 210 * row, 300, 70 + 11 * row);
      return canvas.toDataURL("image/png");
    }, ground);
    const figure = await open(page, [own]);
    const before = await told(figure);
    await figure.locator("input[type=file]").first().setInputFiles({
      name: "stairs.png",
      mimeType: "image/png",
      buffer: Buffer.from(url.split(",")[1], "base64"),
    });
    await expect(figure.locator(".photo .note").first()).toContainText("Made smaller");
    await expect.poll(async () => (await told(figure)).readouts).not.toEqual(before.readouts);
    seen.push(await figure.evaluate((element) => element.toPng().then((blob) => blob.text())));
  }
  expect(seen[0] === seen[1], "the same picture on either ground").toBe(true);
});

test("a photograph that is too narrow is told by its name, as it is and as it would be", async ({ page, open }) => {
  const figure = await open(page, [own]);
  const before = await told(figure);
  const url = await page.evaluate(() => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [64, 3000];
    canvas.getContext("2d").fillRect(0, 0, 20, 20);
    return canvas.toDataURL("image/png");
  });
  await figure.locator("input[type=file]").first().setInputFiles({
    name: "strip.png",
    mimeType: "image/png",
    buffer: Buffer.from(url.split(",")[1], "base64"),
  });
  const notice = figure.locator(".notice");
  await expect(notice).toHaveText(/^strip\.png has 64 × 3000 pixels, made smaller to \d+ × \d+\. This figure takes photographs of at least \d+ pixels on each side\.$/);
  expect(await told(figure)).toEqual(before);
});

test("a photograph can be dropped on the figure, and taken where there is a camera", async ({ page, open }) => {
  const figure = await open(page, [own]);
  const before = await told(figure);
  await figure.evaluate(async (element) => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [300, 200];
    const context = canvas.getContext("2d");
    context.fillStyle = "#dddddd";
    context.fillRect(0, 0, 300, 200);
    context.fillStyle = "#224466";
    context.fillRect(70, 50, 90, 80);
    const blob = await new Promise((done) => canvas.toBlob(done));
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([blob], "desk.png", { type: "image/png" }));
    const picture = element.shadowRoot.querySelector(".picture");
    for (const type of ["dragover", "drop"]) {
      const event = new DragEvent(type, { dataTransfer, bubbles: true, cancelable: true, composed: true });
      // If either event is not canceled, the browser leaves the page to show the file.
      if (picture.dispatchEvent(event)) throw new Error(`${type} was not taken`);
    }
  });
  await expect(figure.locator(".photo .note").first()).toContainText("300 × 200 pixels");
  await expect.poll(async () => (await told(figure)).readouts).not.toEqual(before.readouts);
  const camera = figure.locator("input[capture]").first();
  await expect(camera).toHaveAttribute("capture", "environment");
  await expect(camera).toBeHidden();
});

test("the poster stays until somebody takes an interest", async ({ page, open }) => {
  const figure = await open(page, [plain], { wait: false });
  await expect(figure).toHaveAttribute("data-ready", "");
  const canvas = figure.locator("canvas");
  await expect(canvas).toBeHidden();
  await expect(figure.locator("img").first()).toBeVisible();
  await figure.hover();
  await expect(canvas).toBeVisible();
  await expect(figure.locator("img").first()).toBeHidden();
});

test("the keyboard brings the picture as well as the mouse", async ({ page, open }) => {
  const figure = await open(page, [plain], { wait: false });
  await expect(figure).toHaveAttribute("data-ready", "");
  await figure.locator("input[type=range]").first().focus();
  await expect(figure.locator("canvas")).toBeVisible();
});
