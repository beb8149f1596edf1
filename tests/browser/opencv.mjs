// Benchmark of our WebAssembly against opencv.js, alternating in one page of a headless browser.
// Prints a table of times, ratios and results. `make bench` builds and installs its inputs:
//
//     node opencv.mjs path/to/kernels.wasm

import { chromium } from "@playwright/test";
import { existsSync, readFileSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync } from "node:zlib";
import { launchOptions } from "./chromium.mjs";
import { serve } from "./server.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const kernels = resolve(process.argv[2] ?? "kernels.wasm");
const require = createRequire(join(here, "../bench/package.json"));
const opencv = require.resolve("@techstark/opencv-js");
for (const path of [kernels, opencv]) {
  if (!existsSync(path)) throw new Error(`${path} is missing: run \`make bench\``);
}

const server = await serve({
  mounts: {
    page: () => "<!DOCTYPE html><title>Bench</title>",
    kernels: dirname(kernels),
    opencv: dirname(opencv),
  },
  // opencv.js uses eval.
  policy: false,
});
const browser = await chromium.launch(launchOptions);
const page = await browser.newPage();
await page.goto(`${server.origin}/page`);
await page.addScriptTag({ url: `${server.origin}/opencv/opencv.js` });
const rows = await page.evaluate(compare, { wasm: `${server.origin}/kernels/${kernels.split("/").pop()}` });
await browser.close();
await server.close();

const header = ["in the browser, one thread", "ours", "opencv.js", "ratio", "quality"];
const texts = rows.map(({ name, ours, theirs, quality }) => {
  const other = theirs ? [`${theirs.toFixed(2)} ms`, `${(theirs / ours).toFixed(2)} ×`] : ["has none", ""];
  return [name, `${ours.toFixed(2)} ms`, ...other, quality];
});
const widths = header.map((_, column) => Math.max(...[header, ...texts].map((row) => row[column].length)));
for (const row of [header, ...texts]) {
  console.log(row.map((cell, column) => cell.padEnd(widths[column])).join("  ").trimEnd());
}
const size = (path) =>
  `${(statSync(path).size / 1024).toFixed(0)} KB, ${(brotliCompressSync(readFileSync(path)).length / 1024).toFixed(0)} KB brotli`;
console.log(`these kernels: ${size(kernels)}; opencv.js: ${size(opencv)}`);

/** Runs in the page. */
async function compare({ wasm }) {
  const [SOBEL, GAUSSIAN, HARRIS, MATCH, HOMOGRAPHY, FUNDAMENTAL, SEMI_GLOBAL] = [0, 1, 2, 3, 4, 5, 6];
  const cv = await readyOpenCv();
  const { instance } = await WebAssembly.instantiateStreaming(fetch(wasm));
  const { memory, floats, doubles, prepare, run, result } = instance.exports;
  // Park and Miller's generator; any deterministic one would do.
  let state = 7;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const normal = () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
  const put = (index, values) => {
    const at = floats(index, values.length);
    new Float32Array(memory.buffer, at, values.length).set(values);
  };
  const found = (work) => {
    const length = result(work);
    const isMatrix = work === HOMOGRAPHY || work === FUNDAMENTAL;
    const at = isMatrix ? doubles(length) : floats(2, length);
    return Array.from(new (isMatrix ? Float64Array : Float32Array)(memory.buffer, at, length));
  };
  const rows = [];

  const [width, height] = [1280, 720];
  const gray = rectangles(width, height);
  const frame = cv.matFromArray(height, width, cv.CV_32FC1, gray);
  const outs = [new cv.Mat(), new cv.Mat()];
  const five = new cv.Size(5, 5);
  put(0, gray);
  for (const work of [SOBEL, GAUSSIAN, HARRIS]) {
    if (!prepare(work, width, height)) throw new Error("the frame was refused");
  }
  const sobel = () => {
    cv.Sobel(frame, outs[0], cv.CV_32F, 1, 0);
    cv.Sobel(frame, outs[1], cv.CV_32F, 0, 1);
  };
  const filters = [
    ["Sobel 3×3, both derivatives, 1280×720", SOBEL, sobel, 2],
    ["Gaussian 5×5, 1280×720", GAUSSIAN, () => cv.GaussianBlur(frame, outs[0], five, 1.1), 1],
    ["Harris response, 1280×720", HARRIS, () => cv.cornerHarris(frame, outs[0], 3, 3, 0.04), 1],
  ];
  for (const [name, work, theirs, images] of filters) {
    const times = inTurns(() => run(work), theirs, 20, 8);
    const other = outs.slice(0, images).flatMap((out) => Array.from(out.data32F));
    const mine = found(work);
    const scale = other.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
    const off = mine.reduce((most, value, at) => Math.max(most, Math.abs(value - other[at])), 0);
    rows.push({ name, ...times, quality: `largest difference ${((100 * off) / scale).toExponential(0)} %` });
  }

  {
    const [count, dimension] = [2048, 128];
    const list = () => Float32Array.from({ length: count * dimension }, () => Math.floor(160 * random()));
    const lists = [list(), list()];
    lists.forEach((values, index) => put(index, values));
    prepare(MATCH, dimension, count);
    const mats = lists.map((values) => cv.matFromArray(count, dimension, cv.CV_32FC1, values));
    const matcher = new cv.BFMatcher(cv.NORM_L2, false);
    let pairs = new cv.DMatchVectorVector();
    const theirs = () => {
      pairs.delete();
      pairs = new cv.DMatchVectorVector();
      matcher.knnMatch(mats[0], mats[1], pairs, 2);
    };
    const times = inTurns(() => run(MATCH), theirs, 1, 6);
    const mine = found(MATCH);
    const same = mine.filter((nearest, at) => pairs.get(at).get(0).trainIdx === nearest).length;
    const name = "Two nearest, 2048² × 128";
    rows.push({ name, ...times, quality: `${((100 * same) / count).toFixed(1)} % the same nearest` });
  }

  {
    // Homography: 1000 matches, 40 % outliers, 0.5 px of noise.
    const truth = [0.9, -0.15, 60, 0.12, 1.05, -20, 1e-4, -5e-5, 1];
    const warp = (h, u, v) => {
      const w = h[6] * u + h[7] * v + h[8];
      return [(h[0] * u + h[1] * v + h[2]) / w, (h[3] * u + h[4] * v + h[5]) / w];
    };
    const count = 1000;
    const matches = Array.from({ length: count }, (_, index) => {
      const [u, v] = [640 * random(), 480 * random()];
      const right = warp(truth, u, v).map((value) => value + 0.5 * normal());
      return [u, v, ...(index % 5 < 2 ? [640 * random(), 480 * random()] : right)];
    });
    const at = doubles(4 * count);
    new Float64Array(memory.buffer, at, 4 * count).set(matches.flat());
    prepare(HOMOGRAPHY, 4, count);
    const points = [0, 2].map((from) =>
      cv.matFromArray(count, 1, cv.CV_64FC2, matches.flatMap((match) => match.slice(from, from + 2))),
    );
    const error = (h) => {
      const corners = [[0, 0], [639, 0], [0, 479], [639, 479]];
      const off = corners.map(([u, v]) => {
        const [a, b] = [warp(h, u, v), warp(truth, u, v)];
        return Math.hypot(a[0] - b[0], a[1] - b[1]);
      });
      return (off.reduce((sum, value) => sum + value) / 4).toFixed(3);
    };
    for (const [method, label] of [[cv.RANSAC, "RANSAC"], [cv.USAC_MAGSAC, "USAC_MAGSAC"]]) {
      const mask = new cv.Mat();
      let homography;
      const theirs = () => {
        homography?.delete();
        homography = cv.findHomography(points[0], points[1], method, 1, mask, 10000, 0.999);
      };
      const times = inTurns(() => run(HOMOGRAPHY), theirs, 1, 20);
      const [mine, other] = [error(found(HOMOGRAPHY)), error(Array.from(homography.data64F))];
      const name = `Homography of 1000 matches, 40 % wrong, against ${label}`;
      rows.push({ name, ...times, quality: `corner error ${mine} px, opencv.js ${other} px` });
    }
  }

  {
    // Fundamental matrix: slanted point clouds, converging cameras, 200 matches, 30 % outliers. A
    // frame must not be missed on any problem, so all runs count, not only the fastest.
    const [problems, runs, count] = [40, 5, 200];
    const times = [];
    const nears = [];
    for (let problem = 0; problem < problems; problem += 1) {
      const matches = Array.from({ length: count }, (_, index) => {
        const [x, y, z] = [4 * random() - 2, 3 * random() - 1.5, 4 + 3 * random()];
        const [sin, cos] = [Math.sin(0.1), Math.cos(0.1)];
        const [a, b] = [x * cos - z * sin + 0.7, x * sin + z * cos + 0.2];
        const left = [500 * (x / z) + 320, 500 * (y / z) + 240];
        const right = [500 * (a / b) + 320, 500 * (y / b) + 240];
        const seen = [...left, ...right].map((value) => value + 0.5 * normal());
        return index % 10 < 3 ? [...seen.slice(0, 2), 640 * random(), 480 * random()] : seen;
      });
      const at = doubles(4 * count);
      new Float64Array(memory.buffer, at, 4 * count).set(matches.flat());
      prepare(FUNDAMENTAL, 4, count);
      for (let round = 0; round < runs; round += 1) {
        const start = performance.now();
        if (run(FUNDAMENTAL) === false) throw new Error("our work failed");
        times.push(performance.now() - start);
      }
      const f = found(FUNDAMENTAL);
      const near = matches.filter(([u, v, p, q]) => {
        const line = [0, 3, 6].map((row) => f[row] * u + f[row + 1] * v + f[row + 2]);
        return Math.abs(line[0] * p + line[1] * q + line[2]) < 2 * Math.hypot(line[0], line[1]);
      });
      nears.push(near.length);
    }
    const share = (values, part) => [...values].sort((a, b) => a - b)[Math.ceil(part * values.length) - 1];
    rows.push({
      name: `F of ${count} matches, 30 % wrong: p95 of ${problems} problems`,
      ours: share(times, 0.95),
      quality:
        `median ${share(times, 0.5).toFixed(2)} ms, most ${share(times, 1).toFixed(2)} ms; ` +
        `${share(nears, 0.5)} of ${count} within 2 px of their line, at least ${Math.min(...nears)}`,
    });
  }

  {
    // Stereo pair of rectangles at several depths.
    const [width, height] = [640, 480];
    const pair = [0, 1].map(() => new Float32Array(width * height));
    const truth = new Float32Array(width * height);
    const grain = Float32Array.from({ length: 97 * 89 }, () => 90 * random());
    const patches = [[0, 0, 1.2 * width, height, 4, 80]];
    for (let count = 0; count < 60; count += 1) {
      patches.push([width * random(), height * random(), 120 * random(), 90 * random(), 4 + count, 40 + 120 * random()]);
    }
    for (const [left, top, wide, high, disparity, gray] of patches) {
      for (let v = Math.floor(top); v < Math.min(top + high, height); v += 1) {
        for (let x = Math.floor(left); x < left + wide; x += 1) {
          const value = gray + grain[((x + 31 * disparity) % 97) + 97 * ((v + 17 * disparity) % 89)];
          if (x < width) [pair[0][v * width + x], truth[v * width + x]] = [value, disparity];
          if (x >= disparity && x - disparity < width) pair[1][v * width + x - disparity] = value;
        }
      }
    }
    pair.forEach((values, index) => put(index, values));
    prepare(SEMI_GLOBAL, width, height);
    const { ours } = inTurns(() => run(SEMI_GLOBAL), () => {}, 1, 6);
    const answers = found(SEMI_GLOBAL).map((value, at) => Math.abs(value - truth[at])).filter((off) => off >= 0);
    const right = answers.filter((off) => off < 1).length / answers.length;
    const share = (part) => `${(100 * part).toFixed(1)} %`;
    const quality = `${share(answers.length / truth.length)} have an answer, ${share(right)} of these right`;
    rows.push({ name: "Semi-global, 640×480, 64 disparities, 8 paths", ours, quality });
  }
  return rows;

  /**
   * Runs both alternately. Returns the least time of each, milliseconds, in batches as clocks are
   * coarse.
   */
  function inTurns(ours, theirs, batch, turns) {
    const least = [Infinity, Infinity];
    for (let turn = 0; turn < turns; turn += 1) {
      [ours, theirs].forEach((work, who) => {
        work();
        const start = performance.now();
        for (let round = 0; round < batch; round += 1) {
          if (work() === false) throw new Error("our work failed");
        }
        least[who] = Math.min(least[who], (performance.now() - start) / batch);
      });
    }
    return { ours: least[0], theirs: least[1] };
  }

  /** Gray rectangles with values in [0, 1]: edges and corners everywhere. */
  function rectangles(width, height) {
    const values = new Float32Array(width * height).fill(0.5);
    for (let count = 0; count < (width * height) / 300; count += 1) {
      const [left, top] = [Math.floor(width * random()), Math.floor(height * random())];
      const [right, bottom] = [left + 2 + 30 * random(), top + 2 + 30 * random()];
      const value = random();
      for (let v = top; v < Math.min(bottom, height); v += 1) {
        for (let u = left; u < Math.min(right, width); u += 1) values[v * width + u] = value;
      }
    }
    return values;
  }

  async function readyOpenCv() {
    const loaded = await globalThis.cv;
    if (loaded.Mat) return loaded;
    await new Promise((done) => (loaded.onRuntimeInitialized = done));
    return loaded;
  }
}
