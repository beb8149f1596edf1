// What the tests of the Lab share: a browser that draws WebGL on the processor, the page, and its controls by role.

import { chromium } from "@playwright/test";
import { launchOptions } from "./chromium.mjs";
import { expect, expectAccessible, listen, test as base } from "./fixtures.mjs";
import { book } from "./places.mjs";
import { POLICY, serve } from "./server.mjs";

export { expect, expectAccessible };

// WebGL on the processor: there may be no graphics card.
const args = [
  ...launchOptions.args,
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  // A camera that shows a test picture, and that is allowed.
  "--use-fake-device-for-media-stream",
  "--use-fake-ui-for-media-stream",
];

export const test = base.extend({
  library: [
    async ({}, use) => {
      const server = await serve({ mounts: { course: book }, policy: `${POLICY}; media-src blob:` });
      await use(`${server.origin}/course`);
      await server.close();
    },
    { scope: "worker" },
  ],
  /** A page in which nothing is open yet. */
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

/** The words that a screen reader hears. */
export const said = (page) => page.locator("#said");

/** Operates a control that only assistive technology sees. */
export async function press(page, role, name) {
  const control = page.locator("#widgets").getByRole(role, { name, exact: true }).first();
  await control.dispatchEvent("click");
}

export async function solved(page) {
  await expect(said(page)).toContainText("9 of 9 photographs have a camera", { timeout: 90_000 });
}

/** The bytes of a file that the page gave. */
export async function read(download) {
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  return Buffer.concat(chunks);
}
