// Firefox and WebKit do what Chromium does: every chapter opens, every figure of it answers to keys with the
// same readouts, permalinks bring states back, and the modules give the bits that they give natively.
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
import { serve } from "../browser/server.mjs";
import { chromium, firefox, webkit } from "./drivers.mjs";
import { badlySet, drawPhotograph, dropPhotograph, figuresOf, look, ready, takeHold } from "./steps.mjs";

const ENGINES = { firefox, webkit };
/** What hangs is red before it takes the time of everything after it, milliseconds. */
const ONE_MS = 300_000;
const WHOLE_MS = 1_500_000;
const chosen = Object.keys(ENGINES).filter((name) => name.includes(process.env.ONLY ?? ""));
// The page of all figures comes last: most of them stand in a chapter as they stand there.
const LAST = "gallery.html";
const pages = readdirSync(book)
  .filter((name) => name.endsWith(".html") && name !== "404.html" && name.includes(process.env.PAGES ?? ""))
  .sort((a, b) => Number(a === LAST) - Number(b === LAST));
const plans = plan();
/** A page whose first figure takes photographs of the reader's own. */
const OWN = "corners.html";

const { Figure, figures } = await loadBindings();
const names = JSON.parse(figures()).map(({ name }) => name);
const LOOK = { width: 760, scale: 1, theme: "light", seed: 5, rounds: 2 };

// What is written into a page must come as a script of its own under the policy of the book.
const made = await mkdtemp(join(tmpdir(), "epipole-engines-"));
await writeFile(join(made, "play.js"), `globalThis.play = ${playInPage};\n`);
const player = () => '<!doctype html><html lang="en"><title>Play</title><script src="/made/play.js"></script></html>';

/**
 * What is to be done on each page: how many figures it has, which of them are toured, and of which a permalink is
 * opened. A figure that stands with the same attributes on an earlier page would only say the same again.
 */
function plan() {
  const [seen, linked] = [new Set(), new Set()];
  const isNew = (set, key) => !set.has(key) && set.add(key) !== undefined;
  return new Map(
    pages.map((page) => {
      const tags = [...readFileSync(join(book, page), "utf8").matchAll(/<epipole-figure ([^>]*)>/g)].map(([, words]) => words);
      const toured = [...tags.keys()].filter((index) => isNew(seen, tags[index]));
      const opened = toured.filter((index) => isNew(linked, /name="([^"]*)"/.exec(tags[index])[1]));
      // Whoever comes with parameters sees a state, and no story by the clock, which differs from run to run.
      const query = tags.some((words) => words.includes("data-play")) ? "?still" : "";
      return [page, { count: tags.length, toured, opened, query }];
    }),
  );
}

let server;
let reference;
before(async () => {
  server = await serve({ mounts: { course: book, play: player, made, elements, bindings } });
  reference = await chromium();
});
after(async () => {
  await reference?.close();
  await server?.close();
});

/** What an engine says of a page: each figure at first, after keys on a slider, and on a handle. */
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

/** Without what differs by right: the address, and whether a picture was drawn already. */
const compared = (tour) =>
  tour.map((steps) => steps.map(({ name, state, readouts, description }) => ({ name, state, readouts, description })));

/** What all engines are compared with is computed for the first of them. */
function once(compute) {
  const kept = new Map();
  return (key) => {
    if (!kept.has(key)) kept.set(key, compute(key));
    return kept.get(key);
  };
}

let lastTour = Promise.resolve();
const ofReference = once((page) => {
  // It has one window, so one page after the other.
  const said = lastTour.then(() => tour(reference, page)).then(compared);
  lastTour = said.catch(() => {});
  return said;
});

/** A photograph of the reader's own, and what an engine sees of it in the first figure that takes one. */
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

    /** A page on which the engine itself ends, as WebKit's workers now and then do, gets one more try in a new window. */
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

// One after the other, which leaves WebKit more room: on a busy machine 2.50 was seen to crash and to compute other bits.
chosen.forEach(engineTests);
