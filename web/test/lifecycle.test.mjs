// The lifecycle of a figure, without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";
import { INITIAL, reduce } from "../src/lifecycle.ts";

/** Runs events from a state; returns the last state and the effects of all events by type. */
function run(events, from = INITIAL) {
  let state = from;
  const effects = [];
  for (const event of events) {
    const [next, more] = reduce(state, typeof event === "string" ? { type: event } : event);
    state = next;
    effects.push(...more);
  }
  return { state, effects, types: effects.map(({ type }) => type) };
}

const open = { type: "open", withAddress: false };
const hidden = { type: "visible", visible: false };
const near = { type: "near", near: true };
const visible = { type: "visible", visible: true };
const started = { type: "started", covered: false, waiting: false, linked: false };
const covered = { ...started, covered: true };
const resized = { type: "resized", room: true, relayout: true };
const presented = [{ type: "snapshot", waiting: false }, "presented"];
const frame = (now, more = {}) => ({ type: "frame", now, running: false, ticked: false, ...more });
const input = (now) => ({ type: "input", now });
const drawn = (now) => ({ type: "drawn", now });
const refined = (now, better, more) => ({ type: "refined", now, better, more });

const opened = run([near, visible, "idle", covered, resized]).state;
const behindPoster = run([frame(0), ...presented], opened).state;
const live = run([input(0), frame(0), drawn(0), ...presented], behindPoster).state;

test("a figure opens once it is near the viewport and the page is idle", () => {
  assert.equal(run(["idle"]).state.phase, "poster");
  assert.equal(run([near]).state.phase, "poster");
  const { state, effects } = run([near, "idle", "interest"]);
  assert.equal(state.phase, "loading");
  assert.deepEqual(effects, [{ type: "load", attempt: 1, withAddress: true }]);
});

test("the page, its address and glides open it from afar", () => {
  assert.equal(run([open]).state.phase, "loading");
  assert.equal(run(["wanted"]).state.phase, "loading");
});

test("the poster stays until somebody takes an interest", () => {
  assert.equal(opened.phase, "covered");
  const { state, types } = run([frame(0), ...presented], opened);
  assert.deepEqual(types, ["present", "becomeReady"]);
  assert.equal(state.phase, "covered");
  assert.equal(run(["interest"], state).state.phase, "preparing");
  assert.equal(run(["prepared", "interest"], state).state.phase, "live");
  assert.equal(run(["reveal"], state).state.phase, "preparing");
  assert.equal(run([input(0)], state).state.phase, "preparing");
});

test("a poster that shows the awaited result stays despite interest, but not despite input", () => {
  const waiting = run([frame(0), { type: "snapshot", waiting: true }, "presented", "interest"], opened);
  assert.equal(waiting.state.phase, "covered");
  assert.equal(run(["learned", frame(1), ...presented], waiting.state).state.phase, "preparing");
  assert.equal(run([input(0)], waiting.state).state.phase, "preparing");
});

test("idle work starts where the poster is seen, and stops where it is not", () => {
  assert.deepEqual(run([near, "idle", covered, visible]).types, ["load", "requestFrame", "warm"]);
  assert.deepEqual(run([hidden], opened).types, ["pause"]);
  assert.ok(!run([visible, near, "idle", started]).types.includes("warm"));
});

test("the first picture is prepared in slices while everything else is live", () => {
  const { state, types } = run([input(0), { type: "slice", prepared: false }], behindPoster);
  assert.equal(state.phase, "preparing");
  assert.deepEqual(types, ["requestFrame", "present", "yield"]);
  const last = run([{ type: "slice", prepared: true }], state);
  assert.equal(last.state.phase, "live");
  assert.deepEqual(last.effects.at(-1), { type: "yield", now: true });
});

test("without a poster nothing is presented ahead of the first drawing", () => {
  const { types } = run([near, "idle", started, resized, { type: "slice", prepared: false }]);
  assert.ok(!types.includes("present"));
});

test("without room nothing is drawn", () => {
  const { state } = run([near, "idle", started]);
  assert.deepEqual(run(["flush", { type: "show", hidden: true }], state).types, []);
  assert.deepEqual(run([{ type: "flush" }], { ...state, room: true }).types, ["draw"]);
});

test("a flush draws at once, also from behind the poster", () => {
  const { state, types } = run(["flush"], behindPoster);
  assert.equal(state.phase, "live");
  assert.ok(types.includes("draw"));
  assert.deepEqual(run(["flush"], state).types, []);
});

test("showing presents an unprepared figure, and draws a prepared or hidden one", () => {
  const show = { type: "show", hidden: false };
  assert.deepEqual(run([show], behindPoster).types, ["requestFrame", "present"]);
  assert.ok(run(["prepared", show], behindPoster).types.includes("draw"));
  assert.ok(run([{ ...show, hidden: true }], behindPoster).types.includes("draw"));
});

test("after a rest the view is refined and shown, at the latest when nothing is left", () => {
  assert.equal(live.phase, "live");
  assert.deepEqual(run([frame(50)], live).effects, [{ type: "rest", delay: 70 }]);
  const resting = run([frame(130)], live);
  assert.equal(resting.state.phase, "refining");
  assert.deepEqual(resting.types, ["refine"]);
  const soon = run([refined(140, true, true)], resting.state);
  assert.equal(soon.state.picture, "coarse");
  assert.equal(run([refined(160, true, true)], soon.state).state.picture, "stale");
  const done = run([refined(145, false, false)], soon.state);
  assert.equal(done.state.phase, "sharp");
  assert.deepEqual(run([frame(146)], done.state).types, ["draw"]);
  assert.deepEqual(run([frame(146), frame(147)], done.state).types, ["draw"]);
});

test("input, time and another width make a sharp picture live again", () => {
  const sharp = { ...live, phase: "sharp" };
  for (const event of [input(1), "learned", resized, frame(1, { running: true, ticked: true })]) {
    assert.equal(run([event], sharp).state.phase, "live");
  }
  assert.equal(run(["recolored"], sharp).state.phase, "sharp");
});

test("animation asks for frames, and nothing is refined meanwhile", () => {
  const { types } = run([frame(500, { running: true, ticked: true }), frame(510, { running: true })], live);
  assert.deepEqual(types, ["draw", "requestFrame", "requestFrame"]);
});

test("a figure that nobody sees is not refined", () => {
  assert.deepEqual(run([hidden, frame(500)], live).types, ["pause"]);
});

test("a failed load can be tried again; results of older attempts are outdated", () => {
  const { state, types } = run([near, "idle", { type: "failed", sentence: "No.", retry: true }]);
  assert.equal(state.phase, "failed");
  assert.ok(state.attempt > 1);
  assert.deepEqual(types, ["load", "fail"]);
  assert.equal(run([open], state).state.phase, "loading");
  assert.equal(run(["interest"], state).state.phase, "loading");
});

test("a panic offers another try unless the figure has a Reset of its own", () => {
  const panicked = { type: "failed", sentence: "Stopped." };
  assert.equal(run([panicked], live).effects[0].retry, false);
  assert.equal(run([panicked], opened).effects[0].retry, true);
  assert.deepEqual(run([panicked, input(1), frame(2), "presented"], live).types, ["fail"]);
});

test("a renamed figure opens again if it was open or is near, without address and poster", () => {
  const renamed = { type: "renamed", connected: true };
  const again = run([renamed], live);
  assert.equal(again.state.phase, "loading");
  assert.equal(again.state.ready, false);
  assert.equal(again.effects[0].wasReady, true);
  assert.equal(again.effects[1].withAddress, false);
  assert.equal(run([renamed]).state.phase, "poster");
  assert.equal(run([renamed, near, "idle"]).effects.at(-1).withAddress, false);
});

test("a figure that was renamed outside of any document opens when it comes back", () => {
  const away = run([hidden, { type: "renamed", connected: false }], live);
  assert.equal(away.state.phase, "poster");
  assert.equal(run([near, "idle"], away.state).state.phase, "loading");
});

test("a listener that renames the figure does not make the old one ready", () => {
  const { state, types } = run([{ type: "renamed", connected: true }, ...presented], opened);
  assert.equal(state.ready, false);
  assert.ok(!types.includes("becomeReady"));
});

test("names in attributes are checked once, when nothing is waited for", () => {
  const waiting = run([near, "idle", { ...started, waiting: true }]).state;
  const snapshots = [true, false, true, false].map((waits) => ({ type: "snapshot", waiting: waits }));
  assert.equal(run(snapshots, waiting).types.filter((type) => type === "checkNames").length, 1);
});
