// Failures in the Lab: each shows a message with a way to go on, and the photographs are kept.

import { expect, expectAccessible, give, png, press, said, solved, test } from "./lab.mjs";

test.describe.configure({ mode: "default" });

const notice = (page) => page.locator("#notice");
const file = (name, buffer) => ({ name, mimeType: "image/png", buffer });

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

/** Restarts the Lab after a failure: the files are restored and no longer stored. */
async function goOn(lab) {
  const button = lab.getByRole("button", { name: "Start the Lab again with your 2 files" });
  await expect(button).toBeVisible({ timeout: 30_000 });
  await expect(notice(lab)).toContainText("nothing is lost on your machine");
  await expectAccessible(lab);
  // The stopped page shows the same message; wait for the next page.
  const next = lab.waitForEvent("load", { timeout: 60_000 });
  await button.click();
  await next;
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
  // Replace the script's query for a panic by one that the test controls.
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

/**
 * The module with its memory limited to `numPages` more pages of 64 KiB: rewrites the memory
 * section.
 */
function capped(wasm, numPages) {
  const read = (at) => {
    let [value, shift] = [0, 0];
    for (;;) {
      const byte = wasm[at++];
      value += (byte & 127) * 2 ** shift;
      shift += 7;
      if (byte < 128) return [value, at];
    }
  };
  const written = (value) => {
    const bytes = [];
    for (; value > 127; value = Math.floor(value / 128)) bytes.push((value & 127) | 128);
    return [...bytes, value];
  };
  for (let at = 8; at < wasm.length; ) {
    const [size, body] = read(at + 1);
    if (wasm[at] === 5) {
      // One memory, with a minimum and a maximum.
      const [least] = read(body + 2);
      const section = [1, 1, ...written(least), ...written(least + numPages)];
      return Buffer.concat([wasm.subarray(0, at), Buffer.from([5, ...written(section.length), ...section]), wasm.subarray(body + size)]);
    }
    at = body + size;
  }
  throw new Error("the module has no memory");
}

/** Sets the slider for the size of photographs. */
async function reduceTo(lab, megapixels) {
  const knob = lab.locator("#widgets").getByRole("slider", { name: "Largest size, megapixels" });
  await knob.evaluate((input, value) => {
    input.value = value;
    input.dispatchEvent(new Event("change"));
  }, String(megapixels));
}

test("memory that does not suffice is told, and smaller photographs are the way on", async ({ blank, library, complaints }) => {
  await blank.context().route(/lab-vision[^/]*\.wasm$/, async (route) => {
    const answer = await route.fetch();
    await route.fulfill({ response: answer, body: capped(await answer.body(), 1000) });
  });
  await blank.goto(`${library}/lab/index.html`);
  await solved(blank);
  const large = [file("large.png", png(2400, 1800)), file("other.png", png(2400, 1796))];
  await blank.locator("#photographs").setInputFiles(large);
  await expect(said(blank)).toContainText("large.png: cannot be read: there is not enough memory for this", { timeout: 90_000 });
  await expect(said(blank)).toContainText("reduce photographs to fewer megapixels");
  await expect(said(blank)).toContainText("2 photographs.");
  await expect(notice(blank)).toBeEmpty();
  await reduceTo(blank, 0.1);
  await expect(said(blank)).not.toContainText("not enough memory", { timeout: 60_000 });
  await expect(said(blank)).toContainText("2 photographs.");
  await blank.context().unrouteAll({ behavior: "ignoreErrors" });
  complaints.length = 0;
});

test("a panic in a worker is told, and the next worker goes on", async ({ blank, library, complaints }) => {
  // Modules loaded while `broken` is set panic at every call: they leave a message, then trap.
  let broken = false;
  await blank.context().route("**/broken", (route) => route.fulfill({ status: broken ? 200 : 404, body: "" }));
  await blank.context().route(/assets\/worker-[^/]*\.js$/, async (route) => {
    const answer = await route.fetch();
    const faulty = `
      const load = WebAssembly.instantiateStreaming;
      WebAssembly.instantiateStreaming = async (...all) => {
        const loaded = await load(...all);
        const { ok } = await fetch("broken");
        if (!ok) return loaded;
        const { exports } = loaded.instance;
        const compute = () => {
          throw new WebAssembly.RuntimeError("unreachable");
        };
        const take_panic = () => {
          const message = new TextEncoder().encode("index out of bounds");
          const at = exports.__wbindgen_malloc(message.length, 1);
          new Uint8Array(exports.memory.buffer).set(message, at);
          return [at, message.length];
        };
        return { module: loaded.module, instance: { exports: { ...exports, compute, take_panic } } };
      };`;
    await route.fulfill({ response: answer, body: `${faulty}\n${await answer.text()}` });
  });
  await blank.goto(`${library}/lab/index.html`);
  await solved(blank);
  // Wait for idle workers to be terminated: new ones load the broken module.
  await expect.poll(() => blank.workers().length, { timeout: 60_000 }).toBe(0);
  broken = true;
  await give(blank);
  await expect(said(blank)).toContainText("one.png: cannot be read: this is a mistake of the Lab", { timeout: 30_000 });
  await expect(notice(blank)).toBeEmpty();
  broken = false;
  await press(blank, "button", "Try again");
  await expect(said(blank)).not.toContainText("mistake", { timeout: 30_000 });
  await expect(said(blank)).toContainText("2 photographs.");
  await blank.context().unrouteAll({ behavior: "ignoreErrors" });
  complaints.length = 0;
});
