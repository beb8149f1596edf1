// Benchmark of the Lab in a browser: `node labbench.mjs FOLDER FOCAL_PX` adds the photographs of a
// folder and prints computing time on two cores, frame times meanwhile, the time to stop, the cost
// of a million points, and memory. Times depend on the machine and its load, which is printed.

import { readdirSync, readFileSync } from "node:fs";
import { loadavg } from "node:os";
import { basename, join } from "node:path";
import { chromium } from "@playwright/test";
import { launchOptions } from "./chromium.mjs";
import { book } from "./places.mjs";
import { LAB_POLICY, serve } from "./server.mjs";

const [folder, focal = ""] = process.argv.slice(2);
const args = [
  ...launchOptions.args,
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--enable-precise-memory-info",
];
const server = await serve({ mounts: { course: book }, policy: LAB_POLICY });
const browser = await chromium.launch({ ...launchOptions, args });
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
await page.addInitScript(() => {
  // Report two cores, so that there are two workers.
  Object.defineProperty(navigator, "hardwareConcurrency", { value: 2 });
  // Script time per frame; the rest of a frame is painting, here without a GPU.
  window.work_ms = [];
  const real = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) =>
    real((time) => {
      const from = performance.now();
      callback(time);
      window.work_ms.push(performance.now() - from);
    });
  // Start time of each frame.
  window.frames_ms = [];
  const tick = (time) => {
    window.frames_ms.push(time);
    real(tick);
  };
  real(tick);
  window.tasks_ms = [];
  new PerformanceObserver((list) => {
    for (const { duration } of list.getEntries()) window.tasks_ms.push(duration);
  }).observe({ entryTypes: ["longtask"] });
});
const say = (what, value) => console.log(`${what.padEnd(58)} ${value}`);
const load = () => `(load ${loadavg()[0].toFixed(1)})`;
const begun = performance.now();
await page.goto(`${server.origin}/course/lab/index.html`);
const said = () => page.locator("#said").textContent();
const until = async (pattern, limit = 600_000) => {
  const from = performance.now();
  while (!pattern.test(await said())) {
    if (performance.now() - from > limit) throw new Error(`${pattern} was not said, but: ${await said()}`);
    await page.waitForTimeout(50);
  }
  return performance.now() - from;
};
await page.waitForFunction(() => document.querySelector("#notice")?.textContent === "");
say("the Lab on screen, from the address", `${((performance.now() - begun) / 1e3).toFixed(2)} s ${load()}`);
await until(/9 of 9 photographs have a camera/);
say("the sample solved, from the address", `${((performance.now() - begun) / 1e3).toFixed(2)} s ${load()}`);

const press = (role, name) =>
  page.locator("#widgets").getByRole(role, { name, exact: true }).first().dispatchEvent("click");
const frames = () =>
  page.evaluate(() => ({ frames: window.frames_ms.splice(0), works: window.work_ms.splice(0), tasks: window.tasks_ms.splice(0) }));
const tell = ({ frames, works, tasks }, what) => {
  works.sort((a, b) => a - b);
  const gaps = frames.slice(1).map((time, n) => time - frames[n]).sort((a, b) => a - b);
  const p95 = gaps[Math.floor(0.95 * gaps.length)] ?? 0;
  say(`frames ${what}: p95, longest, tasks above 50 ms`, `${p95.toFixed(1)} ms, ${(gaps.at(-1) ?? 0).toFixed(0)} ms, ${tasks.length} (longest ${Math.max(0, ...tasks)} ms) ${load()}`);
  say("of a frame the Lab's own work: median, p95", `${[0.5, 0.95].map((share) => (works[Math.floor(share * works.length)] ?? 0).toFixed(1)).join(", ")} ms`);
};

/** Whether a process is a descendant of this one; other browsers may be running. */
const isOurs = (id) => {
  for (let at = id; at > 1; ) {
    if (at === process.pid) return true;
    at = Number(readFileSync(`/proc/${at}/status`, "utf8").match(/^PPid:\s+(\d+)/m)?.[1] ?? 0);
  }
  return false;
};
/** Resident memory of the page and its workers, MB. */
const memory = () => {
  let total = 0;
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const words = readFileSync(`/proc/${id}/cmdline`, "utf8");
      if (!words.includes("--type=renderer") || !isOurs(Number(id))) continue;
      total += Number(readFileSync(`/proc/${id}/smaps_rollup`, "utf8").match(/^Pss:\s+(\d+)/m)?.[1] ?? 0) / 1024;
    } catch {
      // The process has ended.
    }
  }
  return total;
};
let most = 0;
// Rarely: reading smaps_rollup blocks the process.
const watching = setInterval(() => (most = Math.max(most, memory())), 3000);
if (folder) {
  const files = readdirSync(folder).filter((name) => name.endsWith(".jpg")).sort().map((name) => join(folder, name));
  await page.goto(`${server.origin}/course/lab/index.html?refine-focal=${focal ? "never" : "guessed"}`);
  await until(/9 of 9 photographs have a camera/);
  for (const count of [2, files.length]) {
    await press("button", "Photographs");
    await press("button", "Project");
    await press("button", "Remove all photographs");
    await until(/No photographs yet/);
    await frames();
    most = 0;
    const from = performance.now();
    await page.locator("#photographs").setInputFiles(files.slice(0, count));
    await until(new RegExp(`${count} photographs`));
    await press("button", count === 2 ? "Two views" : "Reconstruction");
    await until(count === 2 ? /agree\. / : new RegExp(`${count} of ${count} photographs have a camera`));
    say(`${count} photographs, to ${count === 2 ? "their geometry" : "all cameras"}`, `${((performance.now() - from) / 1e3).toFixed(1)} s ${load()}`);
    tell(await frames(), "meanwhile");
    say("memory of the page and its workers, at most", `${most.toFixed(0)} MB`);
  }
  // Dense stereo of some pairs: a million points, rotated by mouse.
  await press("button", "Depth");
  const names = files.map((path) => basename(path));
  let points = 0;
  for (let first = 0; first + 1 < names.length && points < 1e6; first += 1) {
    // Second image first: the two of a pair must differ.
    for (const [list, name] of [["Second", names[first + 1]], ["First", names[first]]]) {
      const box = page.locator("#widgets").getByRole("combobox", { name: new RegExp(`^${list}:`) });
      if ((await box.getAttribute("aria-label")) === `${list}: ${name}`) continue;
      await box.dispatchEvent("click");
      await press("button", name);
      await box.and(page.getByLabel(`${list}: ${name}`)).waitFor({ state: "attached" });
    }
    const pair = `${names[first]} and ${names[first + 1]}: `;
    await until(new RegExp(`^${pair}(\\d+%|.*(cannot|could not|too few|nothing))`));
    const [, share, pixels] = (await said()).match(/: (\d+)% of (\d+) pixels/) ?? [0, 0, 0];
    if (share === 0) console.log(await said());
    else await press("checkbox", "Add to cloud and export");
    points += (share / 100) * pixels;
  }
  say("points of every pixel", points.toFixed(0));
  await press("button", "Reconstruction");
  await page.waitForTimeout(4000);
  await frames();
  await page.mouse.move(500, 400);
  await page.mouse.down();
  for (let n = 0; n < 90; n += 1) await page.mouse.move(500 + 2 * n, 400 + n / 3);
  tell(await frames(), "while a million points turn");
  await page.mouse.up();
  // Time from pressing Stop until no worker is left.
  await press("button", "Features");
  const knob = page.locator("#widgets").getByRole("radio", { name: "SIFT", exact: true }).first();
  await knob.dispatchEvent("click");
  while (page.workers().length === 0) await page.waitForTimeout(20);
  await page.waitForTimeout(700);
  const stopped = performance.now();
  await press("button", "Stop");
  while (page.workers().length > 0 && performance.now() - stopped < 5000) await page.waitForTimeout(5);
  say("Stop, from the press until no worker computes", `${(performance.now() - stopped).toFixed(0)} ms ${load()}`);
  clearInterval(watching);
  await page.waitForTimeout(45_000);
  say("memory at rest", `${memory().toFixed(0)} MB`);
}
clearInterval(watching);
await browser.close();
await server.close();
