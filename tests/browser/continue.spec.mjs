// Coming back: where the reader was, and progress that moves to another browser as a file.

import { readFile } from "node:fs/promises";
import { expect, expectAccessible, listen, test } from "./fixtures.mjs";
import { book } from "./places.mjs";

test.skip(!book, "the book is not what is tested");

const KEY = "epipole-places";
const CHAPTER = "eight-point";
const HEADING = ["one-wrong-match", "One wrong match"];

const stored = (page) => page.evaluate((key) => JSON.parse(localStorage.getItem(key) ?? "[]"), KEY);
/** Stores places before each page of the test. */
const been = (page, ...places) =>
  page.addInitScript(([key, text]) => location.protocol === "about:" || localStorage.setItem(key, text), [KEY, JSON.stringify(places)]);
/** Takes figures away: their own tests check them, and waking them scrolls the page. */
const withoutFigures = (page) => page.evaluate(() => document.querySelectorAll("epipole-figure").forEach((figure) => figure.remove()));
const goTo = (page, id) => page.evaluate((anchor) => document.getElementById(anchor).scrollIntoView({ behavior: "instant" }), id);
const offer = (page) => page.getByRole("navigation", { name: "Where you were" });

/** Sum of all layout shifts so far. */
const shifts = (page) =>
  page.evaluate(
    () =>
      new Promise((done) => {
        let sum = 0;
        const add = (list) => list.getEntries().forEach(({ value }) => (sum += value));
        new PerformanceObserver(add).observe({ type: "layout-shift", buffered: true });
        setTimeout(() => done(sum), 300);
      }),
  );

test("the last heading at which a reader stays is remembered, and the first page leads there", async ({ page, library }) => {
  await page.goto(`${library}/${CHAPTER}.html`, { waitUntil: "networkidle" });
  await goTo(page, "quiz");
  await page.waitForTimeout(500);
  await goTo(page, HEADING[0]);
  await expect.poll(() => stored(page)).toEqual([[CHAPTER, ...HEADING]]);
  await page.goto(`${library}/rays.html`, { waitUntil: "networkidle" });
  await goTo(page, "a-second-camera");
  await expect.poll(() => stored(page)).toEqual([["rays", "a-second-camera", "A second camera"], [CHAPTER, ...HEADING]]);

  await page.goto(`${library}/index.html`, { waitUntil: "networkidle" });
  const link = page.getByRole("link", { name: "Continue: 0 The pinhole camera, A second camera" });
  await expect(link).toBeVisible();
  await link.click();
  await expect(page).toHaveURL(/rays\.html#a-second-camera$/);
  await expect(page.locator("#a-second-camera")).toBeInViewport();
});

for (const [width, height] of [[1280, 720], [390, 844]]) {
  test(`at ${width} px nothing moves, and axe finds nothing wrong`, async ({ page, library }) => {
    await page.setViewportSize({ width, height });
    await been(page, [CHAPTER, ...HEADING]);
    await page.goto(`${library}/index.html`, { waitUntil: "networkidle" });
    await expect(page.locator(".continue a")).toBeVisible();
    // The font of the title alone.
    expect(await shifts(page)).toBeLessThanOrEqual(0.001);
    await withoutFigures(page);
    await expectAccessible(page);
    await page.goto(`${library}/${CHAPTER}.html`, { waitUntil: "networkidle" });
    await expect(offer(page)).toHaveText("Continue at One wrong match");
    expect(await shifts(page)).toBeLessThanOrEqual(0.01);
    const offered = await page.evaluateHandle(() => document.querySelector(".continue-here"));
    await withoutFigures(page);
    expect(await offered.evaluate((box) => box.isConnected)).toBe(true);
    await expectAccessible(page);
    await page.emulateMedia({ colorScheme: "dark" });
    await expectAccessible(page, { colors: true, within: ".continue-here" });
    await offer(page).getByRole("link").click();
    await expect(offer(page)).toHaveCount(0);
    await expect(page.locator(`#${HEADING[0]}`)).toBeInViewport();
  });
}

test("the offer ends when the reader scrolls on, and is for chapters opened at their top", async ({ page, library }) => {
  await been(page, [CHAPTER, ...HEADING], ["rays", "no-longer-there", "No longer there"], ["gone", "a", "A"]);
  await page.goto(`${library}/${CHAPTER}.html`, { waitUntil: "networkidle" });
  await expect(offer(page)).toBeVisible();
  await page.mouse.move(640, 300);
  await page.mouse.wheel(0, 500);
  await expect(offer(page)).toHaveCount(0);
  await page.reload({ waitUntil: "networkidle" });
  await expect(offer(page)).toHaveCount(0);
  for (const address of [`${CHAPTER}.html#quiz`, "rays.html", "stereo.html", "gallery.html"]) {
    await page.goto("about:blank");
    await page.goto(`${library}/${address}`, { waitUntil: "networkidle" });
    await expect(offer(page), address).toHaveCount(0);
  }
});

test("without places the first page keeps no room, and rubbish brings no line", async ({ page, library }) => {
  const height = () => page.locator(".continue").evaluate((line) => line.getBoundingClientRect().height);
  await page.goto(`${library}/index.html`);
  expect(await height()).toBe(0);
  for (const text of ["{", "3", '{"eight-point":"quiz"}', '[["gone","a","A"],["eight-point","a"],["rays",1,2]]']) {
    await page.evaluate(([key, value]) => localStorage.setItem(key, value), [KEY, text]);
    await page.goto(`${library}/index.html`, { waitUntil: "networkidle" });
    await expect(page.locator(".continue a"), text).toHaveCount(0);
  }
  // Words and anchors of a place are text, never markup.
  const odd = [["eight-point", '"><img src=x onerror=alert(1)>', "<b>bold</b>"]];
  await page.evaluate(([key, value]) => localStorage.setItem(key, value), [KEY, JSON.stringify(odd)]);
  await page.goto(`${library}/index.html`, { waitUntil: "networkidle" });
  await expect(page.locator(".continue a")).toHaveText("Continue: 5 The eight-point algorithm, <b>bold</b>");
  await expect(page.locator(".continue img, .continue b")).toHaveCount(0);
});

/** Chooses a file on the page of progress. */
async function give(page, name, text) {
  const chooser = page.waitForEvent("filechooser");
  await page.getByRole("button", { name: "Open a file" }).click();
  await (await chooser).setFiles({ name, mimeType: "application/json", buffer: Buffer.from(text) });
}

test("progress moves to another browser as a file, and both sides keep what they had", async ({ page, library, browser, complaints }) => {
  await page.goto(`${library}/connections.html`);
  const form = page.locator("form.question", { has: page.locator("input[data-answer]") }).first();
  const id = await form.getAttribute("id");
  const answer = form.locator("input[data-answer]");
  await answer.fill(await answer.getAttribute("data-answer"));
  await form.locator(".question-actions button").first().click();
  await expect(form.locator(".verdict")).toContainText("Right.");
  await page.evaluate(([key, places]) => localStorage.setItem(key, JSON.stringify(places)), [KEY, [[CHAPTER, ...HEADING]]]);
  await page.evaluate(() => localStorage.setItem("epipole-goals:column-sizes", '["no-such-goal"]'));
  await page.goto(`${library}/progress.html`);
  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save as a file" }).click();
  const saved = await download;
  expect(saved.suggestedFilename()).toBe("epipole-progress.json");
  const text = await readFile(await saved.path(), "utf8");
  const file = JSON.parse(text);
  expect(file).toMatchObject({ format: "epipole-progress", version: 1, task: {}, goals: [], places: [[CHAPTER, ...HEADING]] });
  expect(Object.keys(file.quiz.connections)).toHaveLength(1);

  const context = await browser.newContext();
  const other = await context.newPage();
  listen(other, complaints);
  await other.goto(`${library}/progress.html`);
  const said = other.locator(".progress-said");
  const solved = other.locator('tr[data-quiz="connections"] .solved');
  await expect(solved).toHaveText(/^0 of \d+$/);
  await give(other, "mine.json", text);
  await expect(said).toHaveText("Added from mine.json: 1 question, 1 place.");
  await expect(solved).toHaveText(/^1 of \d+$/);
  await give(other, "mine.json", text);
  await expect(said).toHaveText("Nothing in mine.json is new here.");
  await expectAccessible(other);

  await other.goto(`${library}/connections.html`);
  await expect(other.locator(`[id="${id}"] .verdict`)).toHaveText("You solved this one.");
  await other.goto(`${library}/index.html`);
  await expect(other.locator(".continue a")).toHaveText("Continue: 5 The eight-point algorithm, One wrong match");

  await other.goto(`${library}/progress.html`);
  await other.getByRole("button", { name: "Forget my progress" }).click();
  await expect(solved).toHaveText(/^0 of \d+$/);
  expect(await other.evaluate(() => Object.keys(localStorage))).toEqual([]);
  await context.close();
});

test("a file that is no progress is refused with a sentence, and changes nothing", async ({ page, library }) => {
  await page.goto(`${library}/progress.html`);
  const said = page.locator(".progress-said");
  const foreign = "is no progress of this book. Choose a file that this page has saved.";
  const start = '{"format":"epipole-progress","version":1';
  for (const [name, text, words] of [
    ["photo.json", "\x89PNG\r\n\x00\xff", foreign],
    ["empty.json", "", foreign],
    ["list.json", "[]", foreign],
    ["deep.json", "[".repeat(200_000), foreign],
    ["other.json", '{"format":"notebook","version":1}', foreign],
    ["huge.json", `${start},"goals":["${"x".repeat(2_000_000)}"]}`, foreign],
    ["later.json", '{"format":"epipole-progress","version":2}', "is from a newer edition of the book. Load this page again, then open the file."],
    ["proto.json", `${start},"__proto__":{"quiz":{}},"quiz":{"__proto__":{"a":"b"},"constructor":{"prototype":{"a":"b"}}},"goals":["__proto__/a"]}`, "Nothing in"],
    ["old.json", `${start},"quiz":{"connections":{"quiz-connections-a":"00000000"},"gone":{"quiz-gone-a":"00000000"}}}`, "Nothing in"],
  ]) {
    await give(page, name, text);
    await expect(said, name).toContainText(words);
    await expect(said).toContainText(name);
  }
  expect(await page.evaluate(() => [Object.keys(localStorage), {}.a])).toEqual([[], undefined]);
});

test("where storage is blocked, the page of progress says that nothing was added", async ({ page, library }) => {
  await page.addInitScript(() => {
    Storage.prototype.setItem = () => {
      throw new DOMException("no room", "QuotaExceededError");
    };
  });
  await page.goto(`${library}/progress.html`);
  await give(page, "mine.json", JSON.stringify({ format: "epipole-progress", version: 1, places: [[CHAPTER, ...HEADING]] }));
  await expect(page.locator(".progress-said")).toHaveText("This browser lets the page keep nothing, so nothing was added.");
});
