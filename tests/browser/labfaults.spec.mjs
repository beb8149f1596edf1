// What can go wrong in the Lab: each ends in a sentence where the reader looks, with a way on, and the photographs stay.

import { deflateSync } from "node:zlib";
import { expect, expectAccessible, said, solved, test } from "./lab.mjs";

test.describe.configure({ mode: "default" });

const notice = (page) => page.locator("#notice");

/** A PNG file that promises so many pixels, gray ones; `whole` keeps the promise. */
function png(width, height, whole = true) {
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

const file = (name, buffer) => ({ name, mimeType: "image/png", buffer });

/** Gives two small photographs, and waits until they are there. */
async function give(lab) {
  await lab.locator("#photographs").setInputFiles([file("one.png", png(64, 48)), file("two.png", png(80, 60))]);
  await expect(said(lab)).toContainText("2 photographs.", { timeout: 30_000 });
}

test("a file that is too large, or that is cut off, is told, and the others stay", async ({ lab }) => {
  await solved(lab);
  const all = [
    file("huge.png", png(10_000, 9_000, false)),
    file("one.png", png(64, 48)),
    file("cut.png", png(300, 200).subarray(0, 120)),
  ];
  await lab.locator("#photographs").setInputFiles(all);
  await expect(said(lab)).toContainText(/huge\.png: cannot be read: .*90000000 pixels/, { timeout: 30_000 });
  await expect(said(lab)).toContainText("cut.png: cannot be read");
  await expect(said(lab)).toContainText("one.png: alone");
});

test("a project of a newer Lab, and a file that is none, leave everything as it is", async ({ lab, library }) => {
  await solved(lab);
  await give(lab);
  const broken = { name: "broken.zip", mimeType: "application/zip", buffer: Buffer.from("no zip file") };
  await lab.locator("#project").setInputFiles([broken]);
  await expect(said(lab)).toContainText("this file is no project of the Lab, or it is damaged", { timeout: 30_000 });
  const { zipSync, strToU8 } = await import("../../web/node_modules/fflate/esm/index.mjs");
  const parts = { "project.json": strToU8(JSON.stringify({ version: 999 })) };
  const newer = { name: "newer.zip", mimeType: "application/zip", buffer: Buffer.from(zipSync(parts)) };
  await lab.locator("#project").setInputFiles([newer]);
  await expect(said(lab)).toContainText("this project was saved by a newer Lab: reload the page to get it", { timeout: 30_000 });
  await expect(said(lab)).toContainText("2 photographs.");
});

test("without WebGL it says what does the same", async ({ blank, library, complaints }) => {
  await blank.addInitScript(() => {
    const real = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
      return kind.startsWith("webgl") ? null : real.call(this, kind, ...more);
    };
  });
  await blank.goto(`${library}/lab/index.html`);
  await expect(notice(blank)).toContainText("The Lab needs WebGL", { timeout: 30_000 });
  await expect(notice(blank)).toContainText("epipole sfm");
  await expectAccessible(blank);
  complaints.length = 0;
});

/** The way on after the Lab has stopped: the files come back, and are kept nowhere any more. */
async function goOn(lab) {
  const button = lab.getByRole("button", { name: "Start the Lab again with your 2 files" });
  await expect(button).toBeVisible({ timeout: 30_000 });
  await expect(notice(lab)).toContainText("nothing is lost on your machine");
  await expectAccessible(lab);
  await button.click();
  await expect(said(lab)).toContainText("2 photographs.", { timeout: 60_000 });
  for (const name of ["one.png", "two.png"]) {
    await expect(lab.locator("#widgets").getByRole("button", { name: new RegExp(`^${name}:`) })).toHaveCount(1);
  }
  await expect(notice(lab)).toBeEmpty();
  await expect.poll(() => lab.evaluate(async () => (await indexedDB.databases()).length)).toBe(0);
}

test("a lost context is told, and the photographs come back", async ({ lab, complaints }) => {
  await solved(lab);
  await give(lab);
  await lab.evaluate(() => {
    const canvas = document.querySelector("#lab");
    const context = canvas.getContext("webgl2") ?? canvas.getContext("webgl");
    context.getExtension("WEBGL_lose_context").loseContext();
  });
  await goOn(lab);
  complaints.length = 0;
});

test("a panic in the page is told, and the photographs come back", async ({ blank, library, complaints }) => {
  // The script asks whether there was one: it hears of one that was not.
  await blank.route(/assets\/lab-[^/]*\.js$/, async (route) => {
    const answer = await route.fetch();
    const text = await answer.text();
    const changed = text.replace(/(\w+)\.panic\(\)(?!\s*\{)/, "(globalThis.panicked ?? $1.panic())");
    await route.fulfill({ response: answer, body: changed });
  });
  await blank.goto(`${library}/lab/index.html`);
  await solved(blank);
  await give(blank);
  await blank.evaluate(() => (globalThis.panicked = "index out of bounds"));
  await goOn(blank);
  complaints.length = 0;
});
