// Course pages with a figure in an iframe, each imitating the listener of a real platform.

import { course, heard } from "./course.mjs";
import { expect, settled, test, told } from "./fixtures.mjs";
import { script } from "./places.mjs";
import { serve } from "./server.mjs";

/** Serves a page with figures for an iframe, on an origin of its own. */
async function inside(site, figures = '<epipole-figure name="ransac-race"></epipole-figure>', more = "") {
  const page = `<!doctype html><html lang="en"><title>Figure</title><body style="margin: 0">${figures}
    <script type="module" src="${site}/elements/${script}"></script>${more}`;
  return serve({ mounts: { "": () => page }, policy: false });
}

/** Opens a course page once its figure is ready. */
async function opened(page, address, hear, frame) {
  const { inner, close } = await course(page, address, hear, frame);
  const figure = inner.locator("epipole-figure").first();
  await expect(figure).toHaveAttribute("data-ready", "");
  return { figure, close };
}

const subjects = (page) => page.evaluate(() => window.heard.map((data) => data.subject ?? "text"));
const saved = (state, more = {}) => ({ v: 1, figure: "ransac-race", state, solved: [], ...more });

for (const [kind, check] of [
  ["objects", "if (typeof event.data === 'object')"],
  ["text", "if (typeof event.data === 'string')"],
]) {
  test(`a page that hears ${kind} gives the frame the height of its figure`, async ({ page, site }) => {
    const inner = await inside(site);
    const listen = `${check} if (data.subject === "lti.frameResize") iframe.style.height = data.height + "px";`;
    const { figure, close } = await opened(page, inner.origin, listen);
    const height = () => figure.evaluate((element) => Math.ceil(element.getBoundingClientRect().height));
    const frame = () => page.locator("iframe").evaluate((element) => element.clientHeight);
    await expect.poll(async () => (await frame()) - (await height())).toBe(0);
    const before = await height();
    await figure.locator(".acts .count").click();
    await expect.poll(height).toBeGreaterThan(before);
    await expect.poll(async () => (await frame()) - (await height())).toBe(0);
    await page.waitForTimeout(600);
    const sizes = (await heard(page, "lti.frameResize")).filter(({ text }) => (text !== undefined) === (kind === "text"));
    // Once at first, and when the list of goals has opened.
    expect(sizes.length).toBeLessThanOrEqual(4);
    for (const size of sizes) expect(Object.keys(size).filter((key) => key !== "text").sort()).toEqual(["height", "message_id", "subject"]);
    expect(new Set(sizes.map(({ message_id }) => message_id)).size).toBe(sizes.length);
    await close();
    await inner.close();
  });
}

test("a figure at rest tells its height three times at most, a compact one never", async ({ page, site }) => {
  for (const [attribute, most] of [["", 3], [" compact", 0]]) {
    const inner = await inside(site, `<epipole-figure name="ransac-race"${attribute}></epipole-figure>`);
    const { close } = await opened(page, inner.origin);
    await page.waitForTimeout(1500);
    const count = (await heard(page, "lti.frameResize")).filter(({ text }) => text === undefined).length;
    expect(count).toBeLessThanOrEqual(most);
    expect(count > 0).toBe(most > 0);
    await close();
    await inner.close();
  }
});

for (const [kind, state] of [
  ["an object", JSON.stringify(saved({ outliers: "0.30", points: "40" }, { solved: ["agree"] }))],
  ["text", JSON.stringify(JSON.stringify(saved({ outliers: "0.30", points: "40" })))],
]) {
  test(`a state that the course has kept as ${kind} comes back`, async ({ page, site }) => {
    const inner = await inside(site, '<epipole-figure name="ransac-race" seed="7"></epipole-figure>');
    const answer = `if (data.subject === "SPLICE.getState") {
      const state = ${state};
      answer({ subject: "SPLICE.getState.response", message_id: "somebody else's", state: {} });
      answer({ subject: "SPLICE.getState.response", message_id: data.message_id, state });
      // A second answer counts for nothing.
      answer({ subject: "SPLICE.getState.response", message_id: data.message_id, state: { ...state, state: { points: "20" } } });
    }`;
    const { figure, close } = await opened(page, inner.origin, answer);
    await expect.poll(async () => (await told(figure)).state).toEqual({ outliers: "0.30", points: "40" });
    await page.waitForTimeout(1500);
    expect((await told(figure)).state).toEqual({ outliers: "0.30", points: "40" });
    // State that came from the course is not reported to it.
    expect(await heard(page, "SPLICE.reportScoreAndState")).toEqual([]);
    await close();
    await inner.close();
  });
}

for (const [what, answer, words] of [
  ["of another figure", saved({}, { figure: "harris" }), 'belongs to the figure "harris"'],
  ["of a newer version", saved({}, { v: 2 }), "comes from a newer version"],
  ["that is none", "{ nothing", "is no state of a figure"],
  ["with a value that is none", saved({ points: "many" }), '"many" is not a value of points'],
  ["with a parameter that there is not", saved({ pionts: "40" }), "pionts"],
]) {
  test(`a kept state ${what} is told in the figure, which works on`, async ({ page, site }) => {
    const inner = await inside(site);
    const listen = `if (data.subject === "SPLICE.getState")
      answer(JSON.stringify({ subject: "SPLICE.getState.response", message_id: data.message_id, state: ${JSON.stringify(answer)} }));`;
    const { figure, close } = await opened(page, inner.origin, listen);
    await expect(figure.locator(".notice")).toContainText(words);
    await figure.locator("input[type=range]").first().press("ArrowRight");
    expect(Object.keys((await told(figure)).state)).toHaveLength(1);
    await close();
    await inner.close();
  });
}

for (const code of ["unsupported_subject", "bad_request", "wrong_origin", "unauthorized"]) {
  test(`a page that answers ${code} is left in peace`, async ({ page, site }) => {
    const inner = await inside(site);
    const listen = `if (data.subject) answer({ subject: data.subject + ".response", message_id: data.message_id, error: { code: "${code}", message: "no" } });`;
    const { figure, close } = await opened(page, inner.origin, listen);
    await settled(figure);
    await page.waitForTimeout(300);
    await expect(figure.locator(".notice")).toBeHidden();
    expect((await told(figure)).state).toEqual({});
    await close();
    await inner.close();
  });
}

test("an answer that comes after the reader's hand changes nothing", async ({ page, site }) => {
  const inner = await inside(site);
  const listen = `if (data.subject === "SPLICE.getState") window.late = () =>
    answer({ subject: "SPLICE.getState.response", message_id: data.message_id, state: ${JSON.stringify(saved({ points: "20" }))} });`;
  const { figure, close } = await opened(page, inner.origin, listen);
  await figure.locator("input[type=range]").first().press("ArrowRight");
  const { state } = await told(figure);
  await page.evaluate(() => window.late());
  await page.waitForTimeout(300);
  expect((await told(figure)).state).toEqual(state);
  await close();
  await inner.close();
});

test("what the reader reaches is reported: at each goal, at rest, when asked", async ({ page, site }) => {
  const inner = await inside(site);
  const { figure, close } = await opened(page, inner.origin);
  expect((await heard(page, "SPLICE.sendEvent")).map(({ name, data }) => [name, data])).toEqual([["ready", { figure: "ransac-race" }]]);
  const goals = await figure.evaluate((element) => element.goals.length);

  await figure.getByRole("slider", { name: "Outlier ratio" }).press("Home");
  await expect.poll(async () => (await heard(page, "SPLICE.reportScoreAndState")).length).toBe(1);
  const [report] = await heard(page, "SPLICE.reportScoreAndState");
  expect(report.activity_id).toBe(`${inner.origin}/`);
  expect(report.score).toBeCloseTo((await figure.evaluate((element) => element.solved.length)) / goals);
  expect(report.state).toEqual(await figure.evaluate((element) => element.saved));
  expect(report.state.solved.length).toBeGreaterThan(0);
  const event = (await heard(page, "SPLICE.sendEvent")).at(-1);
  expect(event.name).toBe("challenge");
  expect(report.state.solved).toContain(event.data.id);

  // A change without a goal is reported after 30 s or on request.
  await figure.evaluate((element) => (element.points = 34));
  await page.waitForTimeout(1500);
  expect(await heard(page, "SPLICE.reportScoreAndState")).toHaveLength(1);
  const ask = () => page.evaluate(() => document.querySelector("iframe").contentWindow.postMessage({ subject: "SPLICE.flushState", message_id: "m1" }, "*"));
  await ask();
  await expect.poll(async () => (await heard(page, "SPLICE.flushState.response")).length).toBe(1);
  const [flushed] = await heard(page, "SPLICE.flushState.response");
  expect(flushed).toEqual({ subject: "SPLICE.flushState.response", message_id: "m1", success: true, hadState: true });
  const reports = await heard(page, "SPLICE.reportScoreAndState");
  expect(reports).toHaveLength(2);
  expect(reports[1].state.state.points).toBe("34");
  await ask();
  await expect.poll(async () => (await heard(page, "SPLICE.flushState.response")).at(-1)?.hadState).toBe(false);

  await figure.getByRole("button", { name: "Reset" }).click();
  await expect.poll(async () => (await heard(page, "SPLICE.sendEvent")).at(-1).name).toBe("reset");
  await close();
  await inner.close();
});

test("what has not been reported is, when the page goes", async ({ page, site }) => {
  const inner = await inside(site);
  const { figure, close } = await opened(page, inner.origin);
  await figure.getByRole("slider", { name: "Outlier ratio" }).press("Home");
  await expect.poll(async () => (await heard(page, "SPLICE.reportScoreAndState")).length).toBe(1);
  await figure.evaluate((element) => (element.points = 24, element.flush()));
  await page.evaluate(() => (document.querySelector("iframe").src = "about:blank"));
  await expect.poll(async () => (await heard(page)).filter(({ subject }) => subject === "SPLICE.reportScoreAndState").at(-1)?.state?.state?.points).toBe("24");
  await close();
  await inner.close();
});

test("an exercise page hears once that everything is solved", async ({ page, site }) => {
  const inner = await inside(site);
  const { figure, close } = await opened(page, inner.origin);
  const ids = await figure.evaluate((element) => element.goals.map(({ id }) => id));
  const passed = async () => (await heard(page)).filter(({ testsPassed }) => testsPassed);
  // All but the last were solved on an earlier visit.
  await figure.evaluate((element, solved) => element.restore({}, { solved }), ids.filter((id) => id !== "agree"));
  expect(await passed()).toEqual([]);
  const before = await figure.evaluate((element) => element.goals.filter(({ solved }) => !solved).map(({ id }) => id));
  expect(before).toHaveLength(1);
  await figure.getByRole("slider", { name: "Outlier ratio" }).press("Home");
  await expect.poll(async () => (await passed()).length).toBe(1);
  expect(typeof (await passed())[0].text).toBe("string");
  await figure.evaluate((element) => (element.reset(), element.flush(), (element.outliers = 0), element.flush()));
  expect(await passed()).toHaveLength(1);
  await close();
  await inner.close();
});

test("a frame without an origin of its own works and talks", async ({ page, site }) => {
  const inner = await inside(site);
  const { figure, close } = await opened(page, inner.origin, "", 'sandbox="allow-scripts"');
  await figure.locator("input[type=range]").first().press("ArrowRight");
  expect(Object.keys((await told(figure)).state)).toHaveLength(1);
  expect(await subjects(page)).toContain("SPLICE.getState");
  await close();
  await inner.close();
});

test("outside of frames nothing is said; of several figures only those that the page connects speak", async ({ page, site }) => {
  const two = '<epipole-figure id="a" name="ransac-race"></epipole-figure><epipole-figure id="b" name="ransac-race"></epipole-figure>';
  const more = `<script type="module">
    import { connect } from "${site}/elements/${script}";
    globalThis.connectB = () => (globalThis.end = connect(document.getElementById("b"), { activity: "week-5" }));
  </script>`;
  const inner = await inside(site, two, more);
  const { close } = await opened(page, inner.origin);
  await page.waitForTimeout(300);
  expect(await subjects(page)).toEqual([]);
  const frame = page.frames()[1];
  await frame.evaluate(() => globalThis.connectB());
  await frame.evaluate(() => document.getElementById("b").whenReady());
  await frame.evaluate(() => (document.getElementById("b").outliers = 0));
  await expect.poll(async () => (await heard(page, "SPLICE.reportScoreAndState")).map(({ activity_id }) => activity_id)).toEqual(["week-5"]);
  await frame.evaluate(() => (globalThis.end(), parent.postMessage({ subject: "the end" }, "*")));
  // Messages arrive in order, so all earlier ones have been received by then.
  await expect.poll(() => subjects(page)).toContain("the end");
  await frame.evaluate(() => ((document.getElementById("b").points = 21), document.getElementById("b").flush()));
  await page.waitForTimeout(1500);
  expect((await subjects(page)).at(-1)).toBe("the end");

  await page.goto(inner.origin);
  await page.evaluate(() => (window.heard = [], addEventListener("message", ({ data }) => window.heard.push(data))));
  await page.evaluate(() => globalThis.connectB());
  await page.waitForTimeout(300);
  expect(await subjects(page)).toEqual([]);
  await close();
  await inner.close();
});
