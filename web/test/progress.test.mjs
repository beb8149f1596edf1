// Reading places and progress files, without a browser.

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { countReached, markReached } from "../book/goals.ts";
import { chapterOf, placesIn, storedPlaces, storePlaces } from "../book/places.ts";
import { addProgress, collectProgress, progressIn } from "../book/progress_file.ts";
import { countSolved, loadSolved, markSolved } from "../book/solved.ts";

/** A storage as that of browsers; `isFull` refuses to store. */
const kept = new Map();
let isFull = false;
globalThis.localStorage = {
  getItem: (key) => kept.get(key) ?? null,
  setItem: (key, value) => {
    if (isFull) throw new Error("full");
    kept.set(key, value);
  },
  removeItem: (key) => kept.delete(key),
};
beforeEach(() => {
  kept.clear();
  isFull = false;
});

const BOOK = {
  solvable: [
    { kind: "quiz", chapter: "rays", wordings: new Map([["quiz-rays-a", "00000001"], ["quiz-rays-b", "00000002"]]) },
    { kind: "task", chapter: "rays", wordings: new Map([["task-ray", "000000000000000a"]]) },
    { kind: "quiz", chapter: "stereo", wordings: new Map([["quiz-stereo-a", "00000003"]]) },
  ],
  goals: ["harris/corner", "harris/edge", "triangulate/far"],
  chapters: ["rays", "stereo"],
};

const file = (more) => JSON.stringify({ format: "epipole-progress", version: 1, ...more });

test("places are those of a well-formed list, one per chapter", () => {
  assert.deepEqual(placesIn([["rays", "a", "A"], ["rays", "b", "B"], ["stereo", "c", "C"]]), [["rays", "a", "A"], ["stereo", "c", "C"]]);
  for (const odd of [null, {}, "rays", [["rays", "a"]], [["rays", "a", 3]], [["rays", "", "A"]], [["rays", "a", "x".repeat(301)]]]) {
    assert.deepEqual(placesIn(odd), []);
  }
  kept.set("epipole-places", "{not json");
  assert.deepEqual(storedPlaces(), []);
});

test("a chapter is the name of its file, with or without its ending", () => {
  for (const pathname of ["/epipole/rays.html", "/rays", "rays.html"]) assert.equal(chapterOf({ pathname }), "rays");
  assert.equal(chapterOf({ pathname: "/epipole/" }), "");
});

test("a file brings everything to an empty browser, and nothing twice", () => {
  markSolved("quiz", "rays", "quiz-rays-a", "00000001");
  markSolved("task", "rays", "task-ray", "000000000000000a");
  markReached("harris/edge");
  storePlaces([["stereo", "depth", "Depth"]]);
  const text = JSON.stringify(collectProgress(BOOK));
  assert.deepEqual(addProgress(progressIn(text, BOOK)), { quiz: 0, task: 0, goals: 0, places: 0 });
  kept.clear();
  assert.deepEqual(addProgress(progressIn(text, BOOK)), { quiz: 1, task: 1, goals: 1, places: 1 });
  assert.equal(JSON.stringify(collectProgress(BOOK)), text);
  assert.deepEqual(addProgress(progressIn(text, BOOK)), { quiz: 0, task: 0, goals: 0, places: 0 });
});

test("merging keeps both sides, and places of this browser win", () => {
  markSolved("quiz", "rays", "quiz-rays-a", "00000001");
  markReached("harris/edge");
  storePlaces([["rays", "mine", "Mine"]]);
  const other = file({
    quiz: { rays: { "quiz-rays-b": "00000002" }, stereo: { "quiz-stereo-a": "00000003" } },
    goals: ["harris/corner", "harris/edge"],
    places: [["rays", "theirs", "Theirs"], ["stereo", "depth", "Depth"]],
  });
  assert.deepEqual(addProgress(progressIn(other, BOOK)), { quiz: 2, task: 0, goals: 1, places: 1 });
  assert.equal(countSolved("quiz", "rays", BOOK.solvable[0].wordings), 2);
  assert.equal(countReached(BOOK.goals), 2);
  assert.deepEqual(storedPlaces(), [["rays", "mine", "Mine"], ["stereo", "depth", "Depth"]]);
});

test("other wordings, unknown chapters, goals and figures are ignored", () => {
  const other = file({
    quiz: { rays: { "quiz-rays-a": "ffffffff", "quiz-rays-z": "00000001" }, gone: { "quiz-rays-a": "00000001" } },
    task: { rays: ["task-ray"] },
    goals: ["harris/gone", "gone/edge", 3, null],
    places: [["gone", "a", "A"], ["https://example.org/", "a", "A"]],
  });
  assert.deepEqual(addProgress(progressIn(other, BOOK)), { quiz: 0, task: 0, goals: 0, places: 0 });
  assert.equal(kept.size, 0);
});

test("an earlier wording that is stored does not count, and is replaced", () => {
  markSolved("quiz", "rays", "quiz-rays-a", "eeeeeeee");
  assert.equal(countSolved("quiz", "rays", BOOK.solvable[0].wordings), 0);
  assert.deepEqual(collectProgress(BOOK).quiz, {});
  addProgress(progressIn(file({ quiz: { rays: { "quiz-rays-a": "00000001" } } }), BOOK));
  assert.equal(countSolved("quiz", "rays", BOOK.solvable[0].wordings), 1);
});

test("names of every object's properties are no chapters, questions or goals", () => {
  const bad =
    '{"format":"epipole-progress","version":1,"__proto__":{"quiz":{"rays":{"quiz-rays-a":"00000001"}}},' +
    '"quiz":{"__proto__":{"rays":{"quiz-rays-a":"00000001"}},"constructor":{"prototype":{"x":"1"}},' +
    '"rays":{"__proto__":{"quiz-rays-a":"00000001"},"toString":"1"}},"goals":["__proto__/corner"],"places":[["__proto__","a","b"]]}';
  assert.deepEqual(addProgress(progressIn(bad, BOOK)), { quiz: 0, task: 0, goals: 0, places: 0 });
  assert.equal({}.x, undefined);
  assert.equal({}.rays, undefined);
  assert.deepEqual(loadSolved("quiz", "rays"), {});
});

test("files that are no progress, and those of newer editions, are told apart", () => {
  const foreign = ["", "{", "[]", "null", "3", '"epipole-progress"', "{}", '{"format":"other","version":1}', '[{"format":"epipole-progress"}]'];
  const noVersion = ['{"format":"epipole-progress"}', '{"format":"epipole-progress","version":"1"}', '{"format":"epipole-progress","version":1.5}'];
  for (const text of [...foreign, ...noVersion]) assert.equal(progressIn(text, BOOK), "foreign", text);
  assert.equal(progressIn('{"format":"epipole-progress","version":2}', BOOK), "newer");
  for (const text of [file({}), file({ quiz: [], task: 3, goals: {}, places: "x" })]) {
    assert.deepEqual(progressIn(text, BOOK), { solutions: [], goals: [], places: [] });
  }
});

test("a full or blocked storage is reported, whatever is added", () => {
  isFull = true;
  for (const more of [{ quiz: { rays: { "quiz-rays-a": "00000001" } } }, { goals: ["harris/edge"] }, { places: [["rays", "a", "A"]] }]) {
    assert.equal(addProgress(progressIn(file(more), BOOK)), undefined);
  }
});
