// Firefox and WebKit behave like Chromium: every chapter opens, its figures respond to keys with
// the same readouts, permalinks restore states, and the modules give the same bits as native code.
//
// `ONLY=webkit` runs one engine, `PAGES=stereo` the pages whose name contains it.

import assert from "node:assert/strict";
import { mkdtemp, writeFile } from "node:fs/promises";
import { readdirSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, describe, test } from "node:test";
import { bindings, book, elements, loadBindings } from "../browser/places.mjs";
import { modulesAt, playInPage, playNatively, write } from "../browser/scripts.mjs";
import { BOOK_POLICY, serve } from "../browser/server.mjs";
import { chromium, firefox, webkit } from "./drivers.mjs";
import { badlySet, drawPhotograph, dropPhotograph, figuresOf, look, ready, runListing, takeHold } from "./steps.mjs";

const ENGINES = { firefox, webkit };
/**
 * Time limits of one test and of an engine, milliseconds: a hanging test must not delay all others.
 */
const ONE_MS = 300_000;
const WHOLE_MS = 1_500_000;
const chosen = Object.keys(ENGINES).filter((name) => name.includes(process.env.ONLY ?? ""));
const plans = plan();
/** Figures' own pages count only with a figure that no chapter shows in that state. */
const pages = [...plans.keys()].filter((page) => !page.includes("/") || plans.get(page).toured.length > 0);
/** A page whose first figure takes photographs of the reader. */
const OWN = "corners.html";

const { Figure, figures } = await loadBindings();
const names = JSON.parse(figures()).map(({ name }) => name);
const LOOK = { width: 760, scale: 1, theme: "light", seed: 5, rounds: 2 };

// Injected code must be a script file, under the content security policy of the book.
const made = await mkdtemp(join(tmpdir(), "epipole-engines-"));
await writeFile(join(made, "play.js"), `globalThis.play = ${playInPage};\n`);
const player = () => '<!doctype html><html lang="en"><title>Play</title><script src="/made/play.js"></script></html>';

/**
 * Test plan by page: number of figures, which to operate, and for which to open a permalink. Skips
 * figures that an earlier page has with the same attributes.
 */
function plan() {
  const pagesIn = (folder) => readdirSync(join(book, folder)).map((name) => join(folder, name));
  const isPage = (name) => name.endsWith(".html") && name !== "404.html" && name.includes(process.env.PAGES ?? "");
  const pages = [...pagesIn(""), ...pagesIn("figures")].filter(isPage);
  const [seen, linked] = [new Set(), new Set()];
  const isNew = (set, key) => !set.has(key) && set.add(key) !== undefined;
  return new Map(
    pages.map((page) => {
      const tags = [...readFileSync(join(book, page), "utf8").matchAll(/<epipole-figure ([^>]*)>/g)].map(([, words]) => words);
      const toured = [...tags.keys()].filter((index) => isNew(seen, tags[index]));
      const opened = toured.filter((index) => isNew(linked, /name="([^"]*)"/.exec(tags[index])[1]));
      // With any query, figures do not play, which would depend on timing.
      const query = tags.some((words) => words.includes("data-play")) ? "?still" : "";
      return [page, { count: tags.length, toured, opened, query }];
    }),
  );
}

let server;
let reference;
before(async () => {
  server = await serve({ mounts: { course: book, play: player, made, elements, bindings }, policy: BOOK_POLICY });
  reference = await chromium();
});
after(async () => {
  await reference?.close();
  await server?.close();
});

/** Readouts of a page's figures: initially, after keys on a slider, and after keys on a handle. */
async function tour(engine, page) {
  const { count, toured, query } = plans.get(page);
  await engine.open(`${server.origin}/course/${page}${query}`);
  const said = [];
  assert.equal(await engine.run(figuresOf), count, "figures on the page");
  for (const index of toured) {
    await engine.run(ready, index);
    const steps = [await engine.run(look, index)];
    for (const what of ["slider", "handle"]) {
      if (!(await engine.run(takeHold, { index, what }))) continue;
      await engine.press("ArrowRight", "ArrowRight", "ArrowLeft", "ArrowDown");
      steps.push(await engine.run(look, index));
    }
    said.push(steps);
  }
  return said;
}

/** The parts to compare, without addresses and whether the picture has been drawn. */
const compared = (tour) =>
  tour.map((steps) => steps.map(({ name, state, readouts, description }) => ({ name, state, readouts, description })));

/** Caches the reference results, which the first engine computes for all. */
function once(compute) {
  const kept = new Map();
  return (key) => {
    if (!kept.has(key)) kept.set(key, compute(key));
    return kept.get(key);
  };
}

let lastTour = Promise.resolve();
const ofReference = once((page) => {
  // The reference has one window, so pages are visited one after another.
  const said = lastTour.then(() => tour(reference, page)).then(compared);
  lastTour = said.catch(() => {});
  return said;
});

/** A reader's photograph, and an engine's results for it in the first figure that takes one. */
const ofPhotograph = once(() => reference.open(`${server.origin}/course/${OWN}`).then(() => reference.run(drawPhotograph)));
async function shown(engine) {
  const base64 = await ofPhotograph();
  await engine.open(`${server.origin}/course/${OWN}`);
  await engine.run(ready, 0);
  const note = await engine.run(dropPhotograph, { index: 0, base64 });
  const { readouts } = await engine.run(look, 0);
  return { note, readouts };
}
const shownByReference = once(() => shown(reference));

const nativeOf = once((name) => playNatively([write(Figure, name, LOOK)])[0]);

const engineTests = (key) =>
  describe(key, { timeout: WHOLE_MS }, () => {
    let engine;
    before(async () => (engine = await ENGINES[key]()));
    after(() => engine?.close());

    /**
     * Repeats a test once in a new window if the engine itself crashes, as WebKit's workers
     * sometimes do.
     */
    async function surviving(report, work) {
      try {
        await work();
      } catch (problem) {
        if (await engine.isAlive()) throw problem;
        report.diagnostic(`${engine.name} has crashed, and begins again: ${problem.message}`);
        await engine.close();
        engine = await ENGINES[key]();
        await work();
      }
    }

    for (const name of names) {
      test(`${name} gives the bits that it gives natively`, { timeout: ONE_MS }, (report) => surviving(report, async () => {
        const scripts = [write(Figure, name, LOOK)];
        const native = nativeOf(name);
        await engine.open(`${server.origin}/play`);
        // In the page, `play` is the same function.
        const there = await engine.run((given) => globalThis.play(given), { ...modulesAt(server.origin), scripts });
        for (const [step, words] of scripts[0].calls.entries()) {
          assert.equal(there[0][step], native[step], `call ${step}: ${words.join(" ")}`);
        }
      }));
    }

    test("a photograph of one's own has the pixels that it has in Chromium", { timeout: ONE_MS }, (report) => surviving(report, async () => {
      const expected = await shownByReference();
      assert.match(expected.note, /Made smaller, from 1531 × 1097/);
      assert.deepEqual(await shown(engine), expected);
    }));

    test("a listing runs, and prints what the book says", { timeout: ONE_MS }, (report) => surviving(report, async () => {
      await engine.open(`${server.origin}/course/epipolar.html`);
      const html = readFileSync(join(book, "epipolar.html"), "utf8");
      const [, recorded] = /id="listing-line-js"[\s\S]*?<samp>([^<]*)<\/samp>/.exec(html);
      assert.equal(await engine.run(runListing, "line"), recorded.trim());
    }));

    for (const page of pages) {
      test(`${page}: its figures answer to keys as in Chromium, and permalinks bring states back`, { timeout: ONE_MS }, (report) => surviving(report, async () => {
        engine.complaints.length = 0;
        const [said, expected] = await Promise.all([tour(engine, page), ofReference(page)]);
        assert.deepEqual(compared(said), expected);
        for (const steps of said) assert.ok(steps.at(-1).colors > 3, `${steps[0].name}: the canvas is not empty`);
        const { toured, opened } = plans.get(page);
        for (const index of opened) {
          const { name, state, permalink } = said[toured.indexOf(index)].at(-1);
          await engine.open(permalink);
          await engine.run(ready, index);
          assert.deepEqual((await engine.run(look, index)).state, state, `${name}: ${permalink}`);
        }
        assert.deepEqual(await engine.run(badlySet), []);
        assert.deepEqual(engine.complaints, [], "errors in the console");
      }));
    }
  });

// One after another, as WebKit 2.50 crashed and gave different bits on a busy machine.
chosen.forEach(engineTests);
