// Listings: tabs, the language for the whole book, copying, and rendering without script and in
// print.

import { expect, test } from "./fixtures.mjs";
import { book } from "./places.mjs";

test.skip(!book, "the book is not what is tested");

const NAMES = { numpy: "NumPy", opencv: "OpenCV", epipole: "Epipole (Python)", rust: "Rust", js: "JavaScript" };
const part = (page, listing, tab) => page.locator(`#listing-${listing}-${tab}`);
const tab = (page, listing, name) => page.locator(`#listing-${listing}`).getByRole("tab", { name });

test("a choice of language holds in all listings, stays where it is, and is remembered", async ({ page, library }) => {
  await page.goto(`${library}/rays.html`);
  await expect(part(page, "one-ray", "numpy")).toBeVisible();
  await expect(part(page, "one-ray", "rust")).toBeHidden();
  const below = tab(page, "second-camera", "Rust");
  await below.scrollIntoViewIfNeeded();
  const before = (await below.boundingBox()).y;
  await below.click();
  expect(Math.abs((await below.boundingBox()).y - before)).toBeLessThan(2);
  await expect(below).toHaveAttribute("aria-selected", "true");
  for (const listing of ["one-ray", "second-camera", "three-rays"]) {
    await expect(part(page, listing, "rust")).toBeVisible();
    await expect(part(page, listing, "numpy")).toBeHidden();
    await expect(part(page, listing, "rust").locator("samp")).not.toBeEmpty();
  }
  await page.goto(`${library}/ransac.html`);
  await expect(part(page, "line", "rust")).toBeVisible();
  // The "line" listing has no OpenCV tab, so it shows its first.
  await tab(page, "two-images", "OpenCV").click();
  await expect(part(page, "two-images", "opencv")).toBeVisible();
  await expect(part(page, "line", "numpy")).toBeVisible();
  await expect(part(page, "line", "rust")).toBeHidden();
  await expect(tab(page, "line", "NumPy")).toHaveAttribute("aria-selected", "true");
});

test("the keys choose as well, also where nothing may be stored", async ({ page, library }) => {
  await page.addInitScript(() => {
    Object.defineProperty(window, "localStorage", {
      get: () => {
        throw new DOMException("no storage here", "SecurityError");
      },
    });
  });
  await page.goto(`${library}/rays.html`);
  const first = tab(page, "one-ray", "NumPy");
  await first.focus();
  for (const [key, name] of [
    ["ArrowRight", "OpenCV"],
    ["ArrowRight", "Epipole (Python)"],
    ["ArrowRight", "Rust"],
    ["ArrowLeft", "Epipole (Python)"],
    ["End", "JavaScript"],
    ["ArrowRight", "NumPy"],
    ["ArrowLeft", "JavaScript"],
    ["Home", "NumPy"],
  ]) {
    await page.keyboard.press(key);
    const chosen = tab(page, "one-ray", name);
    await expect(chosen).toBeFocused();
    await expect(chosen).toHaveAttribute("aria-selected", "true");
    await expect(page.locator("#listing-one-ray").getByRole("tabpanel", { name })).toBeVisible();
  }
  await expect(page.locator("#listing-one-ray [role=tab][tabindex='0']")).toHaveCount(1);
});

test("the button copies the code in sight, and nothing else", async ({ page, context, library }) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.goto(`${library}/rays.html`);
  await tab(page, "three-rays", "OpenCV").click();
  await page.locator("#listing-three-rays .copy").click();
  await expect(page.locator("#listing-three-rays [role=status]")).toHaveText("Code copied");
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  expect(copied).toContain("cv2.SVDecomp(A)");
  expect(copied).not.toContain("smallest singular value: 0");
});

test("without a script and on paper all parts are there, under their names", async ({ browser, page, library }) => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const plain = await context.newPage();
  await plain.goto(`${library}/rays.html`);
  await page.goto(`${library}/rays.html`);
  await page.emulateMedia({ media: "print" });
  for (const shown of [plain, page]) {
    for (const [key, name] of Object.entries(NAMES)) {
      const here = part(shown, "one-ray", key);
      await expect(here).toBeVisible();
      await expect(here.locator(".listing-name")).toHaveText(name);
      await expect(here.locator(".listing-name")).toBeVisible();
      await expect(here.locator("samp")).toContainText("pixel (400, 160)");
    }
    await expect(shown.locator("#listing-one-ray .copy")).toBeHidden();
    await expect(shown.locator("#listing-one-ray .run")).toBeHidden();
    await expect(shown.locator("#listing-one-ray .listing-tabs")).toBeHidden();
  }
  await context.close();
});

test("code lines fit the column of the text", async ({ page, library }) => {
  await page.setViewportSize({ width: 1280, height: 720 });
  for (const name of ["rays", "corners", "sfm"]) {
    await page.goto(`${library}/${name}.html`);
    await expect(page.locator("article > section:not(.settled)")).toHaveCount(0);
    const wide = await page
      .locator(".listing pre")
      .evaluateAll((boxes) => boxes.filter((box) => box.scrollWidth > box.clientWidth + 1).length);
    expect(wide, name).toBe(0);
  }
});

test("on a phone all tabs are in a row, and the choice is remembered", async ({ page, library }) => {
  await page.setViewportSize({ width: 360, height: 640 });
  await page.goto(`${library}/rays.html`);
  const [bar, ...tabs] = await page.locator("#listing-one-ray").evaluate((listing) =>
    // In one step, since the page above may still settle.
    [".listing-bar", "[role=tab]"].flatMap((part) =>
      [...listing.querySelectorAll(part)].map((box) => box.getBoundingClientRect().toJSON()),
    ),
  );
  expect(tabs).toHaveLength(Object.keys(NAMES).length);
  for (const box of tabs) {
    expect(box.y).toBe(tabs[0].y);
    expect(box.left).toBeGreaterThanOrEqual(bar.left);
    expect(box.right).toBeLessThanOrEqual(bar.right);
  }
  await tab(page, "one-ray", "Epipole (Python)").click();
  await page.goto(`${library}/ransac.html`);
  for (const listing of ["line", "samples", "two-images"]) {
    await expect(part(page, listing, "epipole")).toBeVisible();
    await expect(part(page, listing, "rust")).toBeHidden();
  }
});

test("every chapter with Python has its notebook, and the same with its task solved", async ({ page, request, library }) => {
  for (const name of ["rays", "corners", "epipolar", "eight-point", "ransac", "stereo", "sfm", "planes", "calibration"]) {
    await page.goto(`${library}/${name}.html`);
    const links = page.locator(".notebook a");
    await expect(links).toHaveCount(2);
    const sources = [];
    for (const link of await links.all()) {
      await expect(link).toBeVisible();
      const answer = await request.get(await link.evaluate(({ href }) => href));
      expect(answer.ok()).toBe(true);
      const { cells } = await answer.json();
      sources.push(cells.filter(({ cell_type }) => cell_type === "code").map(({ source }) => source.join("")));
    }
    const [open, solved] = sources;
    expect(open.length).toBeGreaterThan(1);
    // One cell differs, in which the task begins.
    expect(solved.filter((source, index) => source !== open[index]).length).toBe(1);
  }
});
