// The examples for pages of the npm package's README: a panorama of two photos, a webcam.

import { expect, test } from "@playwright/test";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { PNG } from "pngjs";
import { cameraOf, inColor, photograph, shade, turn } from "../../web/vision/test/scene.mjs";
import { launchOptions } from "./chromium.mjs";
import { POLICY, serve, TYPES } from "./server.mjs";

const vision = fileURLToPath(new URL("../../web/vision/", import.meta.url));
const readme = readFileSync(join(vision, "README.md"), "utf8");

const [WIDTH, HEIGHT] = [640, 480];
/** Frames of the webcam, and the pixels by which each moves on; then it moves back. */
const FRAMES = 16;
const STEP = [6, 3];

const temporary = mkdtempSync(join(tmpdir(), "webcam-"));
const webcam = join(temporary, "webcam.y4m");
test.use({
  launchOptions: {
    ...launchOptions,
    args: [
      ...launchOptions.args,
      "--use-fake-device-for-media-stream",
      "--use-fake-ui-for-media-stream",
      `--use-file-for-fake-video-capture=${webcam}`,
    ],
  },
});
// A worker may run them more than once for this file, which it loads once.
test.beforeAll(() => {
  mkdirSync(temporary, { recursive: true });
  writeFileSync(webcam, video());
});
test.afterAll(() => rmSync(temporary, { recursive: true, force: true }));

/** Video in gray of a plane that moves by STEP for each frame, and back. */
function video() {
  const [width, height] = [WIDTH + FRAMES * STEP[0], HEIGHT + FRAMES * STEP[1]];
  const plane = Uint8Array.from({ length: width * height }, (_, k) => shade((k % width) / 80, Math.floor(k / width) / 80));
  const chunks = [Buffer.from(`YUV4MPEG2 W${WIDTH} H${HEIGHT} F30:1 Ip A1:1 C420\n`)];
  const there = Array.from({ length: FRAMES }, (_, index) => index);
  for (const index of [...there, ...there.toReversed()]) {
    chunks.push(Buffer.from("FRAME\n"));
    const [left, top] = STEP.map((step) => index * step);
    for (let row = 0; row < HEIGHT; row += 1) {
      const start = (top + row) * width + left;
      chunks.push(Buffer.from(plane.subarray(start, start + WIDTH)));
    }
    chunks.push(Buffer.alloc((WIDTH * HEIGHT) / 2, 128));
  }
  return Buffer.concat(chunks);
}

/** Opens a page with some markup and an example. */
async function open(page, title, markup) {
  const [, code] = readme.split(`## ${title}\n\`\`\`js\n`).map((text) => text.split("```")[0]);
  const example = (_, response) => {
    response.writeHead(200, { "Content-Type": TYPES[".js"] });
    response.end(code.replace("@epipole/vision", "/vision/index.js"));
  };
  const blank = () => `<!doctype html><title>page</title>${markup}<script type="module" src="/example"></script>`;
  const mounts = { vision: join(vision, "dist"), page: blank, example };
  const { origin } = await serve({ mounts, policy: `${POLICY}; worker-src 'self'` });
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  await page.goto(`${origin}/page/`);
  return problems;
}

const png = (image) => PNG.sync.write(Object.assign(new PNG(), inColor(image)));

test("two photos become a panorama", async ({ page }) => {
  const problems = await open(page, "A panorama in a page", '<input type="file" multiple><canvas></canvas>');
  const camera = cameraOf(320, 240, 300);
  const photos = [{}, { rotation: turn(0.01, -0.4, 0.02) }].map((pose) => photograph(camera, pose));
  const names = ["left.png", "right.png"];
  const files = photos.map((photo, k) => ({ name: names[k], mimeType: "image/png", buffer: png(photo) }));
  await page.waitForFunction(() => document.querySelector("input").onchange !== null);
  await page.locator("input").setInputFiles(files);
  await expect(page.locator("canvas")).toHaveAttribute("width", "640");
  const read = () =>
    page.locator("canvas").evaluate((canvas) => {
      const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      return Array.from({ length: data.length / 4 }, (_, k) => (data[4 * k + 3] === 255 ? data[4 * k] : -1));
    });
  await expect.poll(async () => (await read())[0]).toBeGreaterThanOrEqual(0);
  const panorama = await read();
  const { intrinsics } = camera;
  const wide = photograph(cameraOf(640, 240, 300, [intrinsics.cuPx, intrinsics.cvPx]));
  // Beside the left photo.
  const beside = panorama.flatMap((value, k) => (k % 640 >= 320 && value >= 0 ? [Math.abs(value - wide.data[k])] : []));
  expect(beside.length).toBeGreaterThan(20_000);
  expect(beside.reduce((sum, error) => sum + error) / beside.length).toBeLessThan(3);
  expect(problems).toEqual([]);
});

test("the first frame of a webcam is outlined in the others", async ({ page }) => {
  await page.addInitScript(() => {
    window.outlines = [];
    window.Path2D = class extends Path2D {
      constructor(path) {
        super(path);
        window.outlines.push({ corners: path.match(/-?\d+(\.\d+)?(e-?\d+)?/g)?.map(Number) ?? [], time: performance.now() });
      }
    };
  });
  const problems = await open(page, "ORB and a homography over a webcam", "<video></video><canvas></canvas>");
  await expect.poll(() => page.evaluate("window.outlines.length"), { timeout: 60_000 }).toBeGreaterThan(40);
  const outlines = await page.evaluate("window.outlines");
  const found = outlines.filter(({ corners }) => corners.length === 8);
  expect(found.length).toBeGreaterThan(0.9 * outlines.length);
  const frame = [0, 0, WIDTH, 0, WIDTH, HEIGHT, 0, HEIGHT];
  const steps = new Set();
  for (const { corners } of found) {
    const moved = corners.map((place, k) => place - frame[k]);
    const step = Math.round(-moved[0] / STEP[0]);
    for (const [k, by] of moved.entries()) expect(Math.abs(by + step * STEP[k % 2])).toBeLessThan(2);
    steps.add(step);
  }
  expect(steps.size).toBeGreaterThan(5);
  const seconds = (outlines.at(-1).time - outlines[10].time) / 1000;
  test.info().annotations.push({ type: "frames per second", description: ((outlines.length - 11) / seconds).toFixed(1) });
  expect(problems).toEqual([]);
});
