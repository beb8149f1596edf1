// Readers' data stays with them: photographs and numbers are not sent, and the browser stores only
// settings and progress. The pages' own tests check that no other origin is requested.

import { expect, ready, settled, snapshots, test, told } from "./fixtures.mjs";
import { book } from "./places.mjs";
import { kept, leaving, listenIn } from "./privacy.mjs";
import { serve } from "./server.mjs";

const own = snapshots.filter(([, { photos }]) => photos.length > 0).map(([name]) => name);

/** A noisy JPEG, as from a camera, so that no two are alike. */
function photograph(page) {
  return page.evaluate(() => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [320, 240];
    const context = canvas.getContext("2d");
    for (let at = 0; at < 400; at += 1) {
      context.fillStyle = `hsl(${at * 37} 60% ${30 + (at % 50)}%)`;
      context.fillRect((at * 97) % 320, (at * 61) % 240, 8 + (at % 30), 8 + (at % 20));
    }
    return canvas.toDataURL("image/jpeg").split(",")[1];
  });
}

test("one's own photographs go nowhere, and nothing of them is kept", async ({ page, open, site }) => {
  expect(own.length).toBeGreaterThan(1);
  const requests = listenIn(page.context());
  const all = await open(page, own, { wait: false });
  const buffer = Buffer.from(await photograph(page), "base64");
  for (let index = 0; index < own.length; index += 1) {
    const figure = all.nth(index);
    await ready(figure);
    for (const input of await figure.locator("input[type=file]:not([capture])").all()) {
      await input.setInputFiles({ name: "kitchen.jpg", mimeType: "image/jpeg", buffer });
    }
    await expect(figure.locator(".photo .note").first(), own[index]).toContainText("320 × 240 pixels");
    // Wait for results computed from them as well.
    await settled(figure);
    // A permalink cannot contain them.
    expect((await figure.evaluate((element) => element.permalink)).length, own[index]).toBeLessThan(500);
    expect(JSON.stringify((await told(figure)).state).length, own[index]).toBeLessThan(400);
  }
  await page.waitForLoadState("networkidle");
  expect(requests.some(({ url }) => /worker/.test(url)), "workers are heard").toBe(true);
  expect(leaving(requests, site)).toEqual([]);
  expect(await kept(page)).toEqual({ keys: [], besides: [] });
});

test("a browser keeps settings and progress, and forgets what agrees with the usual", async ({ page }) => {
  test.skip(!book, "the book is not what is tested");
  const server = await serve({ mounts: { course: book } });
  const requests = listenIn(page.context());
  await page.setViewportSize({ width: 1400, height: 900 });
  await page.goto(`${server.origin}/course/connections.html`);
  await page.locator(".settings-button").click();
  await page.getByRole("radio", { name: "Dark" }).check();
  await page.keyboard.press("Escape");
  await page.locator(".fold-button").click();
  await page.getByRole("tab", { name: "Rust" }).first().click();
  const form = page.locator("form.question", { has: page.locator("input[data-answer]") }).first();
  const answer = form.locator("input[data-answer]");
  await answer.fill(await answer.getAttribute("data-answer"));
  await form.locator(".question-actions button").first().click();
  const settings = ["epipole-contents", "epipole-listing", "epipole-places", "epipole-quiz:connections", "epipole-settings"];
  // The question is at the end of the chapter, and its heading counts as read after some seconds.
  await expect.poll(() => page.evaluate(() => localStorage.getItem("epipole-places"))).toContain("Quiz");
  expect(await kept(page)).toEqual({ keys: settings, besides: [] });

  await page.goto(`${server.origin}/course/figures/ransac-race.html`);
  await page.getByLabel("Kind of page").selectOption({ index: 1 });
  expect(await kept(page)).toEqual({ keys: [...settings, "epipole-host"].sort(), besides: [] });

  // Everything can be undone.
  await page.locator(".settings-button").click();
  await page.locator(".settings-reset").click();
  await page.goto(`${server.origin}/course/progress.html`);
  await page.locator(".fold-button").click();
  await page.locator(".reset-progress").click();
  expect(await kept(page)).toEqual({ keys: ["epipole-host", "epipole-listing"], besides: [] });
  expect(leaving(requests, server.origin)).toEqual([]);
  await server.close();
});
