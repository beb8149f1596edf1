// Symbols of the text that figures draw: one color, and a highlight in the nearest figure.

import { expect, ready, settled, test } from "./fixtures.mjs";
import { book } from "./places.mjs";

test.skip(!book, "the book is not what is tested");

/** Highlighted shapes of a figure: kind, position relative to the picture's width, and color. */
function light(figure) {
  return figure.evaluate((element) => {
    const svg = element.shadowRoot.querySelector(".lit");
    const { width } = svg.viewBox.baseVal;
    // Hidden shapes do not count.
    const seen = [...svg.querySelectorAll(".color")].filter((shape) => shape.checkVisibility({ visibilityProperty: true }));
    return seen.map((shape) => ({
      kind: shape.localName,
      x: Number(shape.getAttribute(shape.localName === "line" ? "x1" : "cx")) / width,
      color: getComputedStyle(shape).stroke,
    }));
  });
}

/** The figure next to the text with the symbols. */
const beside = "epipole-figure[name=epipolar-plane]";

test("pointing at a letter lights up what the figure has for it, in its color", async ({ page, library }) => {
  await page.goto(`${library}/epipolar.html`);
  const figure = page.locator(beside).first();
  await ready(figure);
  const grip = await figure.evaluate((element) => {
    const box = element.shadowRoot.querySelector("[data-handle=p]").getBoundingClientRect();
    const sheet = element.shadowRoot.querySelector(".sheet").getBoundingClientRect();
    return (box.left + box.width / 2 - sheet.left) / sheet.width;
  });
  const place = {};
  for (const [name, kind] of [["p", "circle"], ["p'", "circle"], ["P", "circle"]]) {
    const near = page.locator(`section:has(${beside}) p [data-symbol="${name}"]`).first();
    await near.hover();
    await expect.poll(() => light(figure)).toHaveLength(1);
    const [lit] = await light(figure);
    expect(lit.kind).toBe(kind);
    expect(lit.color).toBe(await near.evaluate((element) => getComputedStyle(element).color));
    place[name] = lit.x;
  }
  expect(Math.abs(place.p - grip)).toBeLessThan(0.005);
  expect(new Set(Object.values(place)).size).toBe(3);
  await page.locator("h1").hover();
  await expect.poll(() => light(figure)).toHaveLength(0);
});

test("the list of letters takes the keys, and its light follows the figure", async ({ page, library }) => {
  await page.goto(`${library}/epipolar.html`);
  await ready(page.locator(beside).first());
  const line = page.locator('.symbols [data-symbol="ℓ\'"]');
  await line.focus();
  const lit = page.locator("epipole-figure[data-lit]");
  await expect(lit).toHaveCount(1);
  const [before] = await light(lit);
  expect(before.kind).toBe("line");
  const ends = () =>
    lit.evaluate((element) => {
      const shape = element.shadowRoot.querySelector(".lit .color");
      return ["x1", "y1", "x2", "y2"].map((key) => shape.getAttribute(key)).join(" ");
    });
  const first = await ends();
  await lit.evaluate((element) => {
    element.z2 = -1;
    element.flush();
  });
  await expect.poll(ends).not.toBe(first);
  await page.keyboard.press("Escape");
  await expect(page.locator("epipole-figure[data-lit]")).toHaveCount(0);
});

test("a figure that nobody has touched yet is lit where the reader sees it", async ({ page, library }) => {
  await page.goto(`${library}/triangulation.html`);
  const figure = page.locator("epipole-figure[name=triangulate]").first();
  await figure.scrollIntoViewIfNeeded();
  await expect(figure).toHaveAttribute("data-ready", "");
  // The poster is still visible: nothing has woken the figure, as `ready` would.
  expect(await figure.evaluate((element) => element.shadowRoot.querySelector("canvas").hidden)).toBe(true);
  await page.locator('.symbols [data-symbol="X"]').hover();
  await expect(figure).toHaveAttribute("data-lit");
  const ring = () => figure.evaluate((element) => element.shadowRoot.querySelector(".lit .color").getBoundingClientRect().width);
  await expect.poll(ring).toBeGreaterThan(20);
});

test("what no figure draws lights nothing, and without a script letters are plain", async ({ browser, page, library }) => {
  await page.goto(`${library}/epipolar.html`);
  const figure = page.locator(beside).first();
  await ready(figure);
  await page.locator('.symbols [data-symbol="p"]').first().focus();
  const lit = page.locator("epipole-figure[data-lit]");
  await expect(lit).toHaveCount(1);
  expect(await light(lit)).toHaveLength(1);
  // Both epipoles are far outside the images.
  await page.locator('.symbols [data-symbol="e\'"]').focus();
  await expect(lit).toHaveCount(0);
  const context = await browser.newContext({ javaScriptEnabled: false });
  const plain = await context.newPage();
  await plain.goto(`${library}/epipolar.html`);
  await expect(plain.locator('.symbols [data-symbol="p"]').first()).toBeVisible();
  await expect(plain.locator(".symbols [role=button]")).toHaveCount(0);
  await context.close();
});

test("other chapters light their letters as well", async ({ page, library }) => {
  const chapters = [
    ["stereo", "rectify", ["p", "p'"]],
    ["triangulation", "triangulate", ["X"]],
    ["eight-point", "eight-point", ["p", "p'"]],
    ["ransac", "ransac-epipolar", ["p", "p'"]],
  ];
  for (const [chapter, name, letters] of chapters) {
    await page.goto(`${library}/${chapter}.html`);
    const figure = page.locator(`epipole-figure[name=${name}]`).first();
    await ready(figure);
    await settled(figure);
    for (const letter of letters) {
      await page.locator(`.symbols [data-symbol="${letter}"]`).focus();
      await expect.poll(async () => (await light(page.locator("epipole-figure[data-lit]").first())).map(({ kind }) => kind)).toEqual(["circle"]);
      await page.keyboard.press("Escape");
    }
  }
});

test("a letter that is pointed at too early lights up once there is something to light", async ({ page, library }) => {
  let release;
  const held = new Promise((resolve) => (release = resolve));
  await page.route(/epipole-jobs.*\.wasm/, async (route) => {
    await held;
    await route.continue();
  });
  await page.goto(`${library}/ransac.html`);
  const figure = page.locator("epipole-figure[name=ransac-epipolar]").first();
  await ready(figure);
  await page.locator('.symbols [data-symbol="p"]').focus();
  await expect(page.locator("epipole-figure[data-lit]")).toHaveCount(0);
  release();
  const lit = page.locator("epipole-figure[data-lit]");
  await expect(lit).toHaveCount(1);
  expect((await light(lit)).map(({ kind }) => kind)).toEqual(["circle"]);
});
