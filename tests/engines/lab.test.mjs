// Firefox and WebKit solve the Lab's sample with the same result as Chromium: points and error.
//
// `ONLY=webkit` runs one engine.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { book } from "../browser/places.mjs";
import { LAB_POLICY, serve } from "../browser/server.mjs";
import { chromium, firefoxWindow, webkit } from "./drivers.mjs";

const ENGINES = { firefox: firefoxWindow, webkit };
const chosen = Object.keys(ENGINES).filter((name) => name.includes(process.env.ONLY ?? ""));

if (!existsSync(join(book, "lab/index.html"))) throw new Error("the Lab is missing: run `make lab` first");

/** Runs in the page: the Lab's messages once it has found cameras, or failed. */
async function solved() {
  const rest = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  const text = (id) => document.getElementById(id)?.textContent ?? "";
  for (let tries = 0; tries < 6000; tries += 1) {
    if (/have a camera|Nothing could|needs WebGL|has stopped/.test(text("said") + text("notice"))) break;
    await rest(50);
  }
  return { said: text("said"), notice: text("notice") };
}

describe("the sample of the Lab", { timeout: 1_800_000 }, () => {
  let server;
  let expected;
  const solve = async (open) => {
    const engine = await open();
    try {
      await engine.open(`${server.origin}/course/lab/index.html`);
      return await engine.run(solved);
    } finally {
      await engine.close();
    }
  };
  before(async () => {
    // Without the precomputed results, every engine has to compute them.
    const missing = /\/sample-[^/]*\.bin$/;
    server = await serve({ mounts: { course: book }, policy: LAB_POLICY, missing });
    expected = await solve(chromium);
    assert.match(expected.said, /9 of 9 photographs have a camera; \d+ points/);
  });
  after(() => server?.close());
  for (const key of chosen) {
    test(`${key} solves it as Chromium does`, async (report) => {
      let found;
      try {
        found = await solve(ENGINES[key]);
      } catch (problem) {
        // If the engine itself crashes, as WebKit sometimes does, try once more.
        report.diagnostic(`${key} begins again: ${problem.message}`);
        found = await solve(ENGINES[key]);
      }
      assert.deepEqual(found, expected);
    });
  }
});
