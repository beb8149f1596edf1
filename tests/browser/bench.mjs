// Browser benchmark: frame times of each figure, size of the module, and WebAssembly against native
// code. Prints one table. Times depend on the machine; only ratios can be compared elsewhere.
// With names of figures as arguments, times only their frames: node bench.mjs harris

import { chromium } from "@playwright/test";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { brotliCompressSync, constants } from "node:zlib";
import { launchOptions } from "./chromium.mjs";
import { figurePage } from "./pages.mjs";
import { bindings, code, elements, here, jobsWasm, loadBindings, root, wasm } from "./places.mjs";
import { modulesAt, playInPage, playNatively } from "./scripts.mjs";
import { serve } from "./server.mjs";

const MOVES = 200;
const module = await loadBindings();
const figures = JSON.parse(module.figures());
const wanted = process.argv.slice(2);
const server = await serve({
  mounts: { figures: figurePage, pages: join(here, "pages"), elements, bindings },
});
const browser = await chromium.launch(launchOptions);
const rows = [];

/** Processor time used by the browser, seconds; a busy machine hardly changes it. */
const system = await browser.newBrowserCDPSession();
async function cpuSeconds() {
  const { processInfo } = await system.send("SystemInfo.getProcessInfo");
  return processInfo.filter(({ type }) => type !== "browser").reduce((sum, { cpuTime }) => sum + cpuTime, 0);
}

const quantile = (times, share) =>
  [...times].sort((a, b) => a - b)[Math.min(times.length - 1, Math.floor(share * times.length))];
const ms = (time) => `${time.toFixed(1)} ms`;
const kb = (bytes) => `${(bytes / 1024).toFixed(0)} KB`;

for (const { name } of figures.filter(({ name }) => wanted.length === 0 || wanted.includes(name))) {
  const context = await browser.newContext({ viewport: { width: 820, height: 900 }, deviceScaleFactor: 2 });
  const page = await context.newPage();
  await page.goto(`${server.origin}/figures?figure=${name}`);
  await page.locator("epipole-figure[data-ready]").waitFor();
  const sliders = await page.locator("epipole-figure input[type=range]").count();
  // The canvas shows the poster until something is drawn.
  const pixels = await page.locator("epipole-figure").evaluate((element) => {
    element.flush();
    const { width, height } = element.shadowRoot.querySelector("canvas");
    return `${width} × ${height}`;
  });
  const grips = await page.locator("epipole-figure .grip").count();
  const kinds = {
    slider: Array.from({ length: sliders }, (_, index) => [slide, { index, moves: Math.ceil(MOVES / sliders) }]),
    drag: grips > 0 ? [[drag, { moves: MOVES }]] : [],
  };
  for (const [kind, runs] of Object.entries(kinds)) {
    const before = await cpuSeconds();
    const times = [];
    for (const [run, given] of runs) times.push(...(await page.evaluate(run, given)));
    const cpu = (1000 * ((await cpuSeconds()) - before)) / times.length;
    if (times.length === 0) continue;
    const [p50, p95] = [quantile(times, 0.5), quantile(times, 0.95)];
    rows.push([`${name}: ${kind} → frame, ${pixels}`, `p50 ${ms(p50)}`, `p95 ${ms(p95)}`, `processor ${ms(cpu)}`]);
  }
  await context.close();
}

if (wanted.length === 0) {
  const compress = (path) => {
    const bytes = readFileSync(join(elements, path));
    const params = { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length };
    return [kb(bytes.length), `${kb(brotliCompressSync(bytes, { params }).length)} brotli`];
  };
  rows.push([`WebAssembly, ${figures.length} figures`, ...compress(wasm)]);
  rows.push(["WebAssembly, their long computations", ...compress(jobsWasm)]);
  rows.push(["elements, script", ...compress(code)]);
}

if (wanted.length === 0) {
  // The RANSAC race run to its end several times: sampling, fitting and scoring, without drawing.
  const calls = [];
  for (let seed = 1; seed <= 20; seed += 1) {
    calls.push(["set_number", "outliers", 0.7], ["set_number", "points", 100], ["set_number", "seed", seed]);
    calls.push(["press", "restart"], ["press", "run"]);
    for (let tick = 0; tick < 300; tick += 1) calls.push(["tick", 0.1]);
  }
  const script = { figure: "ransac-race", width: 760, scale: 1, theme: "light", calls };
  const scripts = [script, script, script, script, script];
  execFileSync("cargo", ["build", "--quiet", "--release", "--example", "trace"], {
    cwd: root,
    stdio: "ignore",
  });
  const native = playNatively(scripts, "--time");
  const page = await browser.newPage();
  await page.goto(`${server.origin}/figures`);
  const there = await page.evaluate(playInPage, {
    ...modulesAt(server.origin),
    scripts,
    timed: true,
  });
  const [ours, theirs] = [quantile(native, 0.5), quantile(there, 0.5)];
  rows.push(["RANSAC runs: native, WebAssembly", ms(ours), ms(theirs)]);
  rows.push(["RANSAC runs: WebAssembly / native", `${(theirs / ours).toFixed(2)} ×`]);
}

await browser.close();
await server.close();
const widths = [0, 1, 2].map((column) => Math.max(...rows.map((row) => (row[column] ?? "").length)));
for (const row of rows) console.log(row.map((cell, column) => cell.padEnd(widths[column] ?? 0)).join("  ").trimEnd());

/**
 * Runs in the page: moves a slider through its range and times each move until its frame is drawn.
 */
async function slide({ index, moves }) {
  const element = document.querySelector("epipole-figure");
  const input = element.shadowRoot.querySelectorAll("input[type=range]")[index];
  const context = element.shadowRoot.querySelector("canvas").getContext("2d");
  const [low, high] = [Number(input.min), Number(input.max)];
  const before = input.value;
  const times = [];
  for (let move = 0; move < moves; move += 1) {
    // Up and back down in small steps, like a hand.
    const share = 1 - Math.abs(((2 * move) / moves) % 2 - 1);
    await new Promise(requestAnimationFrame);
    const start = performance.now();
    input.value = String(low + share * (high - low));
    input.dispatchEvent(new Event("input", { bubbles: true }));
    element.flush();
    // Reading a pixel back waits for the canvas.
    context.getImageData(0, 0, 1, 1);
    times.push(performance.now() - start);
  }
  input.value = before;
  input.dispatchEvent(new Event("input", { bubbles: true }));
  return times;
}

/** Runs in the page: drags the first handle and times each move. */
async function drag({ moves }) {
  const element = document.querySelector("epipole-figure");
  const stage = element.shadowRoot.querySelector(".picture");
  const context = element.shadowRoot.querySelector("canvas").getContext("2d");
  // Draw the pending change of the last slider, which may move the handle.
  element.flush();
  const box = element.shadowRoot.querySelector(".grip").getBoundingClientRect();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const fire = (type, dx, dy) =>
    stage.dispatchEvent(
      new PointerEvent(type, {
        pointerId: 1,
        pointerType: "mouse",
        isPrimary: true,
        button: type === "pointermove" ? -1 : 0,
        buttons: type === "pointerup" ? 0 : 1,
        clientX: x + dx,
        clientY: y + dy,
        bubbles: true,
        cancelable: true,
      }),
    );
  // Synthetic pointers cannot be captured.
  stage.setPointerCapture = () => {};
  fire("pointerdown", 0, 0);
  const times = [];
  for (let move = 0; move < moves; move += 1) {
    const turn = (2 * Math.PI * move) / 50;
    await new Promise(requestAnimationFrame);
    const start = performance.now();
    fire("pointermove", 60 * Math.sin(turn), 30 * Math.sin(2 * turn));
    element.flush();
    context.getImageData(0, 0, 1, 1);
    times.push(performance.now() - start);
  }
  fire("pointerup", 0, 0);
  return times;
}
