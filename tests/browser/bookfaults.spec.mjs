// Pages of the book with failing storage, scripts or search index: the page works, names what fails
// and offers a way to retry.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "./fixtures.mjs";
import { book } from "./places.mjs";
import { POLICY, serve, TYPES } from "./server.mjs";

test.skip(!book, "the book is not what is tested");

/** Serves the book; files in `site.fails` are missing, requests for `site.stuck` never end. */
async function library() {
  const site = { fails: undefined, stuck: undefined };
  const course = async (url, response) => {
    const path = decodeURIComponent(url.pathname.slice("/course/".length));
    if (site.stuck?.test(path)) return;
    response.setHeader("Content-Security-Policy", POLICY);
    if (site.fails?.test(path)) return void response.writeHead(404).end();
    const bytes = readFileSync(join(book, path));
    response.writeHead(200, { "Content-Type": TYPES[path.slice(path.lastIndexOf("."))] ?? "text/plain" }).end(bytes);
  };
  return Object.assign(site, await serve({ mounts: { course } }));
}

/** Failing or corrupt browser storage. */
const STORES = {
  forbidden: () => {
    Object.defineProperty(window, "localStorage", {
      get: () => {
        throw new DOMException("not here", "SecurityError");
      },
    });
  },
  "full of rubbish": () => {
    const quizzes = ['[1,{"a":null},"right"]', '{"a":1,"b":null,"__proto__":{"c":"d"},"e":["f"]}', "\0"];
    Storage.prototype.getItem = (key) => (key.includes("quiz") ? quizzes[key.length % quizzes.length] : '{"light');
    Storage.prototype.setItem = () => {
      throw new DOMException("no room", "QuotaExceededError");
    };
  },
};

for (const [what, corrupt] of Object.entries(STORES)) {
  test(`where storage is ${what}, pages work and say what they cannot remember`, async ({ page }) => {
    const site = await library();
    await page.addInitScript(corrupt);
    await page.setViewportSize({ width: 1400, height: 900 });
    await page.goto(`${site.origin}/course/connections.html`);
    const root = page.locator("html");
    await page.locator(".settings-button").click();
    await page.getByRole("radio", { name: "Dark" }).check();
    await expect(root).toHaveAttribute("data-theme", "dark");
    await page.keyboard.press("Escape");
    await page.locator(".fold-button").click();
    await expect(root).toHaveAttribute("data-contents", "folded");
    const tab = page.getByRole("tab", { name: "Rust" }).first();
    await tab.click();
    await expect(tab).toHaveAttribute("aria-selected", "true");
    const form = page.locator("form.question", { has: page.locator("input[data-answer]") }).first();
    await expect(form.locator(".verdict")).toBeEmpty();
    const answer = form.locator("input[data-answer]");
    await answer.fill(await answer.getAttribute("data-answer"));
    await form.locator("button[type=submit], .question-actions button").first().click();
    await expect(form.locator(".verdict")).toHaveText(/^Right. This browser keeps nothing/);

    await page.goto(`${site.origin}/course/progress.html`);
    for (const cell of await page.locator(".progress .solved").all()) await expect(cell).toHaveText(/^0 of \d+$/);
    for (const cell of await page.locator(".progress .reached").all()) await expect(cell).toHaveText(/^0 of \d+$/);
    await expect(page.locator(".progress .kept")).toContainText("keep nothing");
    await page.locator(".reset-progress").click();
    await site.close();
  });
}

test("a script of the page that does not come, and an index that does not, are told and asked for again", async ({ page, complaints }) => {
  const site = await library();
  const search = page.locator(".search-button");
  const notice = page.locator(".page-notice");
  site.fails = /assets\/(quiz|search)-.*\.js/;
  await page.goto(`${site.origin}/course/connections.html`);
  await expect(notice).toContainText("A part of this page could not be loaded.");
  const isMissing = (response) => /assets\/search-.*\.js$/.test(response.url()) && response.status() === 404;
  await Promise.all([page.waitForResponse(isMissing), search.click()]);
  await expect(notice).toHaveCount(1);
  site.fails = undefined;
  await notice.getByRole("button", { name: "Load the page anew" }).click();
  await expect(page.locator(".question-actions").first()).toBeVisible();
  await expect(notice).toHaveCount(0);

  await page.evaluate(() => {
    // Shorten the search's limit of 15 s to 0.5 s. Not before: the modules have the same limit.
    const real = window.setTimeout;
    window.setTimeout = (work, delay, ...more) => real(work, delay === 15_000 ? 500 : delay, ...more);
  });
  const status = page.locator(".search-status");
  const input = page.getByRole("searchbox");
  site.fails = /assets\/search-.*\.json/;
  await search.click();
  await input.fill("epipole");
  await expect(status).toContainText("could not be loaded");
  site.fails = undefined;
  site.stuck = /assets\/search-.*\.json/;
  await status.getByRole("button", { name: "Try again" }).click();
  await expect(status).toContainText("is slow to come");
  await expect(input).toBeFocused();
  site.stuck = undefined;
  await status.getByRole("button", { name: "Try again" }).click();
  await expect(page.locator(".search-results a").first()).toBeVisible();
  await expect(status).toContainText("section");
  // The browser itself logs the missing files.
  expect(complaints.filter((text) => !/404/.test(text))).toEqual([]);
  complaints.length = 0;
  await site.close();
});
