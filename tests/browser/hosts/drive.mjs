// Requirements for a figure in every host.

import { expect, followed, test } from "../fixtures.mjs";

const state = (figure) => figure.evaluate((element) => (element.flush(), element.state));

async function ready(figure) {
  await figure.scrollIntoViewIfNeeded();
  await expect(figure).toHaveAttribute("data-ready", "", { timeout: 60_000 });
  await figure.dispatchEvent("pointerenter");
}

/** Position of the first handle once it has stopped moving, as pages lay themselves out late. */
async function grip(figure) {
  const found = figure.locator(".grip").first();
  await found.scrollIntoViewIfNeeded();
  let place;
  await expect(async () => {
    const before = place;
    const box = await found.boundingBox();
    place = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    expect(place).toEqual(before);
  }).toPass({ intervals: [100], timeout: 30_000 });
  return place;
}

/** Operates `ransac-race` by mouse, touch and keys; no event reaches the page. */
export async function operate(page, figure) {
  await ready(figure);
  const before = await state(figure);
  const from = await grip(figure);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 24, from.y + 12, { steps: 6 });
  await page.mouse.up();
  const dragged = await state(figure);
  expect(dragged, "dragged by the mouse").not.toEqual(before);

  const touch = await page.context().newCDPSession(page);
  const at = await grip(figure);
  const send = (type, touchPoints) => touch.send("Input.dispatchTouchEvent", { type, touchPoints });
  await send("touchStart", [{ x: at.x, y: at.y }]);
  for (let step = 1; step <= 6; step += 1) await send("touchMove", [{ x: at.x - 4 * step, y: at.y + 2 * step }]);
  await send("touchEnd", []);
  const swiped = await state(figure);
  expect(swiped, "dragged by a finger").not.toEqual(dragged);

  const address = page.url();
  await figure.locator(".grip").first().focus();
  await page.keyboard.press("ArrowLeft");
  expect(await state(figure), "moved by keys").not.toEqual(swiped);
  const outside = () => page.evaluate(() => [...document.body.querySelectorAll("*")].filter((element) => !element.closest("epipole-figure")).length);
  const elements = await outside();
  for (const key of [" ", "a", "b", "j", "f", "s", "/", "."]) await page.keyboard.press(key);
  await page.waitForTimeout(300);
  expect(page.url(), "keys turn no page").toBe(address);
  expect(await outside(), "keys change nothing around the figure").toBe(elements);
  await page.keyboard.press("Escape");
}

/** Waits for the long computation of `disparity-map`. */
export async function answers(figure) {
  await ready(figure);
  await figure.evaluate((element) => element.flush());
  await expect(figure.locator("[aria-busy]")).toHaveCount(0, { timeout: 90_000 });
  await expect.poll(() => figure.evaluate((element) => element.readoutText("bad") ?? Object.values(element.readouts).join(" ")), { timeout: 60_000 }).toMatch(/\d/);
  await expect(figure.locator(".notice")).toBeHidden();
}

/**
 * Expects the figure to follow its page to dark and back within 1 s; load may delay one of the two.
 */
export async function follows(figure, darken, lighten) {
  await expect(figure.locator(".root")).toHaveAttribute("data-theme", "light");
  const took = [await followed(figure, "dark", darken), await followed(figure, "light", lighten)];
  test.info().annotations.push({ type: "follows", description: took.map((ms) => `${Math.round(ms)} ms`).join(", ") });
  expect(Math.min(...took), "milliseconds until the figure follows its page").toBeLessThanOrEqual(1000);
}
