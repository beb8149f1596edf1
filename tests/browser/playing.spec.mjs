// The home page's figure plays by itself, and the last stage of a reconstruction is saved to a
// file.

import { readFileSync } from "node:fs";
import { expect, ready, settled, test, told } from "./fixtures.mjs";
import { book } from "./places.mjs";

test.skip(!book, "these are pages of the book");

const cover = "epipole-figure[data-play]";

/** Whether the animation is playing. */
function isPlaying(figure) {
  return figure.evaluate((element) => {
    element.flush();
    return element.readoutText("points") !== undefined && "time" in element.state;
  });
}

test("the cover tells its story once it is in sight, and the reader may stop it", async ({ page, library }) => {
  await page.setViewportSize({ width: 1280, height: 500 });
  await page.goto(`${library}/index.html`);
  const figure = page.locator(cover);
  await expect(figure).toHaveAttribute("data-ready", "");
  // Nothing plays out of view.
  await page.waitForTimeout(1000);
  expect(await isPlaying(figure)).toBe(false);
  await page.setViewportSize({ width: 1280, height: 900 });
  await figure.scrollIntoViewIfNeeded();
  await expect.poll(() => isPlaying(figure), { timeout: 60_000 }).toBe(true);
  await figure.getByRole("button", { name: "Pause" }).click();
  await page.waitForTimeout(200);
  const { state } = await told(figure);
  await page.waitForTimeout(600);
  expect((await told(figure)).state).toEqual(state);
});

test("a reader who wants no motion, or has come for a state, sees no story", async ({ page, library }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto(`${library}/index.html`);
  const figure = page.locator(cover);
  await ready(figure);
  await settled(figure);
  await page.waitForTimeout(1000);
  expect((await told(figure)).state).toEqual({});
  await page.emulateMedia({ reducedMotion: "no-preference" });
  await page.goto(`${library}/index.html?step=rays#fig-start`);
  await ready(figure);
  await settled(figure);
  await page.waitForTimeout(1000);
  expect((await told(figure)).state).toEqual({ step: "rays", time: "4.00" });
});

test("points in space are saved as a PLY file, as many as the figure says", async ({ page, open }) => {
  const figure = await open(page, ["two-view-sfm"]);
  const save = figure.getByRole("button", { name: "Save points" });
  const waiting = page.waitForEvent("download");
  await save.click();
  const download = await waiting;
  expect(download.suggestedFilename()).toBe("two-view-sfm.ply");
  const text = readFileSync(await download.path()).toString("latin1");
  const number = /^ply\nformat binary_little_endian 1\.0\n[^]*element vertex (\d+)\n/.exec(text)[1];
  const { readouts } = await told(figure);
  expect(number).toBe(readouts.points);
  await figure.evaluate((element) => element.apply({ stage: "match" }));
  await expect(save).toHaveAttribute("aria-disabled", "true");
});

test("goals that were reached are remembered, count on the page of progress, and can be forgotten", async ({ page, library }) => {
  const expectProgress = async (chapter, words) => {
    await page.goto(`${library}/progress.html`);
    await expect(page.locator(`.progress tr[data-quiz="${chapter}"] .reached`)).toHaveText(words);
  };
  await expectProgress("eight-point", /^0 of \d+$/);
  await page.goto(`${library}/eight-point.html`);
  const figure = page.locator('epipole-figure[name="column-sizes"]').first();
  await ready(figure);
  expect(await figure.evaluate((element) => element.solved)).toEqual([]);
  await figure.getByRole("slider", { name: "Image width" }).press("End");
  await figure.evaluate((element) => element.flush());
  const [reached] = await figure.evaluate((element) => element.solved);
  expect(reached).toBeTruthy();
  await expectProgress("eight-point", /^1 of \d+$/);

  // On the next visit, the figure knows the goal but starts in the page's state.
  await page.goto(`${library}/eight-point.html`);
  await ready(figure);
  await expect.poll(() => figure.evaluate((element) => element.solved)).toEqual([reached]);
  expect((await told(figure)).state).toEqual({});
  await page.goto(`${library}/index.html`);
  await expect(page.locator('.small .solved[data-quiz="eight-point"]').first()).toHaveText(/^1 of \d+ goals reached$/);

  await page.goto(`${library}/progress.html`);
  await page.locator(".reset-progress").click();
  await expect(page.locator('.progress tr[data-quiz="eight-point"] .reached')).toHaveText(/^0 of \d+$/);
  expect(await page.evaluate(() => Object.keys(localStorage))).toEqual([]);
});
