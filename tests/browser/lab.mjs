// Shared by the Lab's tests: a browser with software WebGL, the page, and its controls by role.

import { deflateSync } from "node:zlib";
import { chromium } from "@playwright/test";
import { launchOptions } from "./chromium.mjs";
import { expect, expectAccessible, listen, test as base } from "./fixtures.mjs";
import { book } from "./places.mjs";
import { LAB_POLICY, serve } from "./server.mjs";

export { expect, expectAccessible };

// Software WebGL, as there may be no GPU.
const args = [
  ...launchOptions.args,
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  // A fake camera with permission granted.
  "--use-fake-device-for-media-stream",
  "--use-fake-ui-for-media-stream",
];

export const test = base.extend({
  library: [
    async ({}, use) => {
      const server = await serve({ mounts: { course: book }, policy: LAB_POLICY });
      await use(`${server.origin}/course`);
      await server.close();
    },
    { scope: "worker" },
  ],
  /** A blank page. */
  blank: async ({ complaints }, use) => {
    const browser = await chromium.launch({ ...launchOptions, args });
    const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
    const page = await context.newPage();
    listen(page, complaints);
    await use(page);
    await browser.close();
  },
  lab: async ({ blank, library }, use) => {
    await blank.goto(`${library}/lab/index.html`);
    await use(blank);
  },
});

/** The live region of the page. */
export const said = (page) => page.locator("#said");

/** Clicks a control that only assistive technology sees. */
export async function press(page, role, name) {
  const control = page.locator("#widgets").getByRole(role, { name, exact: true }).first();
  await control.dispatchEvent("click");
}

/** Chooses an item of the Project menu, opening and closing the menu. */
export async function choose(page, role, name) {
  const item = page.locator("#widgets").getByRole(role, { name, exact: true });
  await expect(item).toHaveCount(0);
  await press(page, "button", "Project");
  await item.dispatchEvent("click");
  await expect(item).toHaveCount(0);
}

export async function solved(page) {
  await expect(said(page)).toContainText("9 of 9 photographs have a camera", { timeout: 90_000 });
}

/** The bytes of a download. */
export async function read(download) {
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  return Buffer.concat(chunks);
}

/** A gray PNG of the given size; without `whole`, its pixels are missing. */
export function png(width, height, whole = true) {
  const chunk = (name, data) => {
    const body = Buffer.concat([Buffer.from(name), data]);
    const length = Buffer.alloc(4);
    length.writeUInt32BE(data.length);
    const check = Buffer.alloc(4);
    check.writeUInt32BE(crc(body));
    return Buffer.concat([length, body, check]);
  };
  const head = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, 8, 0, 0, 0, 0]);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  const rows = Buffer.alloc(whole ? (width + 1) * height : 10, 0);
  for (let v = 0; whole && v < height; v += 1) {
    for (let u = 0; u < width; u += 1) rows[v * (width + 1) + 1 + u] = ((u >> 3) ^ (v >> 3)) & 1 ? 200 : 40;
  }
  const mark = Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  return Buffer.concat([mark, chunk("IHDR", head), chunk("IDAT", deflateSync(rows)), chunk("IEND", Buffer.alloc(0))]);
}

function crc(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit += 1) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** A photograph for a file input. */
export const file = (name, width, height) => ({ name, mimeType: "image/png", buffer: png(width, height) });

/** Adds two small photographs and waits until they are listed. */
export async function give(lab) {
  await lab.locator("#photographs").setInputFiles([file("one.png", 64, 48), file("two.png", 80, 60)]);
  await expect(said(lab)).toContainText("2 photographs.", { timeout: 30_000 });
}
