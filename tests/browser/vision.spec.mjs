// The npm package of the core in a page: worker and thread, parts on demand, failures to load.

import { fileURLToPath } from "node:url";
import { expect, test } from "@playwright/test";
import { POLICY, serve } from "./server.mjs";

const dist = fileURLToPath(new URL("../../web/vision/dist", import.meta.url));

/** Opens an empty page beside the package. */
async function open(page, { policy = `${POLICY}; worker-src 'self'`, missing } = {}) {
  const blank = () => "<!doctype html><title>page</title>";
  const server = await serve({ mounts: { vision: dist, page: blank }, policy, missing });
  const requests = [];
  page.context().on("request", (request) => requests.push(new URL(request.url()).pathname));
  await page.goto(`${server.origin}/page/`);
  return requests;
}

for (const worker of [undefined, true, false]) {
  test(`a page computes with worker ${worker}, and fetches only the part it needs`, async ({ page }) => {
    const requests = await open(page);
    const found = await page.evaluate(async (worker) => {
      const { Vision } = await import("/vision/index.js");
      const vision = await Vision.load(worker === undefined ? {} : { worker });
      const square = [[0, 0], [100, 0], [100, 100], [0, 100], [30, 70], [60, 20]];
      const report = await vision.estimateHomography(square, square.map(([u, v]) => [2 * u + 1, 2 * v]));
      vision.close();
      return { numInliers: report.numInliers, type: report.model.constructor.name };
    }, worker);
    expect(found).toEqual({ numInliers: 6, type: "Float64Array" });
    expect(requests.filter((path) => path.endsWith(".wasm"))).toEqual(["/vision/parts/homography.wasm"]);
    expect(requests.includes("/vision/worker.js")).toBe(worker !== false);
  });
}

test("an ImageData gives features, in the worker and in the page", async ({ page }) => {
  await open(page);
  const counts = await page.evaluate(async () => {
    const { Vision } = await import("/vision/index.js");
    const canvas = new OffscreenCanvas(160, 120);
    const context = canvas.getContext("2d");
    for (let at = 0; at < 80; at += 1) {
      context.fillStyle = `hsl(${at * 37} 60% ${20 + ((at * 13) % 60)}%)`;
      context.fillRect((at * 97) % 160, (at * 61) % 120, 8 + (at % 13), 8 + (at % 11));
    }
    const image = context.getImageData(0, 0, 160, 120);
    const all = await Promise.all([true, false].map((worker) => Vision.load({ worker })));
    const features = await Promise.all(all.map((vision) => vision.detectSift(image)));
    for (const vision of all) vision.close();
    return features.map(({ keypoints, descriptors }) => [keypoints.points.length / 2, descriptors.data.length / 128]);
  });
  expect(counts[0][0]).toBeGreaterThan(20);
  expect(counts[0][1]).toBe(counts[0][0]);
  expect(counts[1]).toEqual(counts[0]);
});

test("abort ends a long call while the page goes on", async ({ page }) => {
  await open(page);
  const result = await page.evaluate(async () => {
    const { Vision } = await import("/vision/index.js");
    const vision = await Vision.load();
    const world = await vision.twoViewProblem({ numPoints: 2000, outlierFraction: 0.6 });
    let frames = 0;
    const tick = () => {
      frames += 1;
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
    const stages = new Set();
    const progress = (stage) => stages.add(stage);
    const endless = { minIterations: 1e9, maxIterations: 1e9, signal: AbortSignal.timeout(400), progress };
    const problem = await vision.estimateFundamental(world.pixels1, world.pixels2, endless).catch((error) => error.name);
    const next = await vision.fitHomography([0, 0, 1, 0, 1, 1, 0, 1], [0, 0, 1, 0, 1, 1, 0, 1]);
    vision.close();
    return { problem, frames, stages: [...stages], next: next.length };
  });
  expect(result).toMatchObject({ problem: "TimeoutError", stages: ["drawing samples"], next: 9 });
  expect(result.frames).toBeGreaterThan(5);
});

for (const [what, options, says] of [
  ["no WebAssembly", { policy: `${POLICY.replace(" 'wasm-unsafe-eval'", "")}; worker-src 'self'` }, /^the part homography cannot be loaded: .*WebAssembly/],
  ["no module", { missing: /homography\.wasm$/ }, /^the part homography cannot be loaded: .*homography\.wasm answers 404$/],
]) {
  for (const worker of [true, false]) {
    test(`${what} is an error with its cause, with worker ${worker}`, async ({ page }) => {
      await open(page, options);
      const problem = await page.evaluate(async (worker) => {
        const { Vision } = await import("/vision/index.js");
        const vision = await Vision.load({ worker });
        const square = [0, 0, 1, 0, 1, 1, 0, 1];
        return vision.fitHomography(square, square).then(() => "no error", (error) => error.message);
      }, worker);
      expect(problem).toMatch(says);
    });
  }
}

for (const [what, options] of [
  ["no script of the worker", { missing: /worker\.js$/ }],
  ["no script of the parts", { missing: /parts\.js$/ }],
  ["a policy without workers", { policy: `${POLICY}; worker-src 'none'` }],
]) {
  test(`${what} is an error`, async ({ page }) => {
    await open(page, options);
    const problem = await page.evaluate(async () => {
      const { Vision } = await import("/vision/index.js");
      const vision = await Vision.load();
      const square = [0, 0, 1, 0, 1, 1, 0, 1];
      return vision.fitHomography(square, square).then(() => "no error", (error) => error.message);
    });
    expect(problem).toMatch(/^the worker has stopped: |cannot run in a worker: /);
  });
}

test("pictures of the browser are images", async ({ page }) => {
  await open(page);
  const found = await page.evaluate(async () => {
    const { Vision } = await import("/vision/index.js");
    const canvas = new OffscreenCanvas(40, 30);
    const context = canvas.getContext("2d");
    for (let u = 0; u < 40; u += 1) {
      context.fillStyle = `rgb(${6 * u} ${255 - 6 * u} ${3 * u})`;
      context.fillRect(u, 0, 1, 30);
    }
    const data = context.getImageData(0, 0, 40, 30);
    const blob = await canvas.convertToBlob({ type: "image/png" });
    const bitmap = await createImageBitmap(canvas);
    const frame = new VideoFrame(canvas, { timestamp: 0 });
    const pictures = { blob, file: new File([blob], "photo.png", { type: "image/png" }), bitmap, frame };
    const vision = await Vision.load();
    const expected = await vision.photoToGray(data);
    const worst = {};
    for (const [kind, picture] of Object.entries(pictures)) {
      const gray = await vision.photoToGray(picture);
      worst[kind] = Math.max(...gray.data.map((value, index) => Math.abs(value - expected.data[index])));
    }
    frame.close();
    bitmap.close();
    const problems = [];
    for (const bad of [bitmap, new Blob(["no image"], { type: "image/png" })]) {
      problems.push(await vision.photoToGray(bad).catch((error) => `${error.name}: ${error.message}`));
    }
    problems.push(await vision.matchPhotos([data, new Blob(["no image"])]).catch((error) => error.message));
    vision.close();
    return { worst, problems };
  });
  // A VideoFrame may pass through another color space.
  expect(found.worst).toEqual({ blob: 0, file: 0, bitmap: 0, frame: expect.any(Number) });
  expect(found.worst.frame).toBeLessThan(0.02);
  expect(found.problems).toEqual([
    "TypeError: photo is closed: call before its close()",
    "TypeError: photo of type image/png cannot be decoded: pass an image that this browser shows",
    "photos[1] of unknown type cannot be decoded: pass an image that this browser shows",
  ]);
});

test("a loaded part answers for the parts that it contains", async ({ page }) => {
  const requests = await open(page);
  const length = await page.evaluate(async () => {
    const { Vision } = await import("/vision/index.js");
    const vision = await Vision.load({ parts: ["geometry"] });
    const square = [0, 0, 1, 0, 1, 1, 0, 1];
    const { length } = await vision.fitHomography(square, square);
    vision.close();
    return length;
  });
  expect(length).toBe(9);
  expect(requests.filter((path) => path.endsWith(".wasm"))).toEqual(["/vision/parts/geometry.wasm"]);
});
