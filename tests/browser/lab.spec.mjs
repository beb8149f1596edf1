// The Lab as it is served: the sample is solved, files go in and out, and assistive technology finds
// everything by role.

import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "@playwright/test";
import { launchOptions } from "./chromium.mjs";
import { expect, expectAccessible, listen, test as base } from "./fixtures.mjs";
import { book } from "./places.mjs";
import { serve } from "./server.mjs";

// WebGL on the processor: there may be no graphics card.
const args = [...launchOptions.args, "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

const test = base.extend({
  library: [
    async ({}, use) => {
      const server = await serve({ mounts: { course: book } });
      await use(`${server.origin}/course`);
      await server.close();
    },
    { scope: "worker" },
  ],
  lab: async ({ library, complaints }, use) => {
    const browser = await chromium.launch({ ...launchOptions, args });
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
    const page = await context.newPage();
    listen(page, complaints);
    await page.goto(`${library}/lab/index.html`);
    await use(page);
    await browser.close();
  },
});

test.describe.configure({ mode: "serial" });

/** The words that a screen reader hears. */
const said = (page) => page.locator("#said");

/** Operates a control that only assistive technology sees. */
async function press(page, role, name) {
  const control = page.locator("#widgets").getByRole(role, { name, exact: true }).first();
  await control.dispatchEvent("click");
}

async function solved(page) {
  await expect(said(page)).toContainText("9 of 9 photographs have a camera", { timeout: 90_000 });
}

test("the sample is solved, looked at in every step, and saved", async ({ lab }) => {
  await solved(lab);
  await expect(lab.locator("#notice")).toBeEmpty();

  await press(lab, "button", "Matches");
  await expect(said(lab)).toContainText("36 of 36 pairs share enough matches", { timeout: 60_000 });
  await press(lab, "button", "Two views");
  await expect(said(lab)).toContainText("A scene with depth from two places");
  await press(lab, "button", "Features");
  await expect(said(lab)).toContainText(/table-1\.png: \d+ features/);

  await press(lab, "button", "Export");
  await expect(said(lab)).toContainText("Ready to save: 9 cameras");
  const [download] = await Promise.all([
    lab.waitForEvent("download"),
    press(lab, "button", "Save reconstruction.zip"),
  ]);
  expect(download.suggestedFilename()).toBe("reconstruction.zip");
  const bytes = await read(download);
  expect(bytes.subarray(0, 2).toString()).toBe("PK");
  for (const name of ["sparse/0/cameras.txt", "sparse/0/points3D.txt", "points.ply", "images/table-9.png"]) {
    expect(bytes.includes(name), name).toBe(true);
  }
});

test("knobs recompute, and undo brings the result back at once", async ({ lab }) => {
  await solved(lab);
  await press(lab, "button", "Photographs");
  await press(lab, "checkbox", "takes part");
  await expect(said(lab)).toContainText("table-1.png: left out by you");
  await press(lab, "button", "Reconstruction");
  await expect(said(lab)).toContainText("8 of 9 photographs have a camera", { timeout: 60_000 });
  await press(lab, "button", "Undo");
  await expect(said(lab)).toContainText("9 of 9 photographs have a camera", { timeout: 2_000 });
});

test("one's own files take the place of the sample; what is no photograph is told", async ({ lab }) => {
  await solved(lab);
  const folder = mkdtempSync(join(tmpdir(), "lab-"));
  const broken = join(folder, "broken.jpg");
  writeFileSync(broken, Buffer.from([0xff, 0xd8, 0xff, 0, 1, 2]));
  await lab.locator("#photographs").setInputFiles([broken]);
  await expect(said(lab)).toContainText("broken.jpg: cannot be read", { timeout: 30_000 });
  await press(lab, "button", "Undo");
  await press(lab, "button", "Undo");
  await press(lab, "button", "Reconstruction");
  await solved(lab);
});

test("Escape and Tab leave the canvas, and axe finds nothing wrong", async ({ lab }) => {
  await solved(lab);
  await lab.locator("#lab").focus();
  await lab.keyboard.press("Tab");
  await expect(lab.getByRole("link", { name: "Epipole" })).not.toBeFocused();
  await lab.keyboard.press("Escape");
  await lab.keyboard.press("Shift+Tab");
  await expect(lab.getByRole("link", { name: "Epipole" })).toBeFocused();
  await expectAccessible(lab);
  await lab.emulateMedia({ colorScheme: "dark" });
  await expectAccessible(lab);
});

async function read(download) {
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  return Buffer.concat(chunks);
}
