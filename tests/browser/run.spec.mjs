// Code that runs in the page: output, errors with their line, limits, figures, kept code, links.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, expectAccessible, test } from "./fixtures.mjs";
import { book, root } from "./places.mjs";

test.skip(!book, "the book is not what is tested");

/** Numbered chapters of the book, in its order. */
const CHAPTERS = [...readFileSync(join(root, "content/SUMMARY.md"), "utf8").matchAll(/^- .*\((.*)\.md\)$/gm)].map(
  ([, name]) => name,
);
const HEAD = 'import { Vision } from "@epipole/vision";\nconst vision = await Vision.load();\n';
const listing = (page) => page.locator("#listing-line");
const output = (page) => listing(page).locator(".run-output");
const status = (page) => listing(page).locator(".run-bar p");
const button = (page) => listing(page).locator("button.run");

/** Opens the editor of a listing, without waiting for what it prints. */
async function open(page, library) {
  await page.goto(`${library}/epipolar.html`);
  await button(page).click();
  await expect(status(page)).toHaveText(/^Done in/);
}

/** Replaces the code, through the clipboard's event, as a reader pastes. */
async function write(page, code, box = listing(page)) {
  await box.locator(".cm-content").evaluate((content, code) => {
    content.focus();
    const selection = content.getRootNode().getSelection?.() ?? getSelection();
    selection.selectAllChildren(content);
    const clipboardData = new DataTransfer();
    clipboardData.setData("text/plain", code);
    content.dispatchEvent(new ClipboardEvent("paste", { clipboardData, bubbles: true, cancelable: true }));
  }, code);
}

async function run(page, code) {
  await write(page, code);
  await button(page).click();
  await expect(button(page)).toHaveAttribute("data-state", "ready", { timeout: 20_000 });
}

test("every listing prints in the page what the book says", async ({ page, library }) => {
  test.setTimeout(240_000);
  let count = 0;
  for (const chapter of CHAPTERS) {
    await page.goto(`${library}/${chapter}.html`);
    for (const box of await page.locator(".listing:not(.task):has([data-tab=js])").all()) {
      const said = await box.locator(".listing-part[data-tab=js] .prints samp").textContent();
      await box.locator("button.run").click();
      await expect(box.locator(".run-bar p")).toHaveText(/^Done in/, { timeout: 20_000 });
      await expect(box.locator(".run-output samp")).toHaveText(said.trim());
      count += 1;
    }
  }
  expect(count).toBeGreaterThan(15);
});

test("every task refuses what it starts from, accepts its solution, and counts it", async ({ page, library }) => {
  test.setTimeout(300_000);
  const solved = [];
  for (const chapter of CHAPTERS) {
    await page.goto(`${library}/${chapter}.html`);
    const tasks = await page.locator(".task:has(button.run)").all();
    for (const task of tasks) {
      const [button, verdict] = [task.locator("button.run"), task.locator(".run-verdict")];
      await expect(button).toHaveText("Check");
      await button.click();
      await expect(verdict.or(task.locator(".run-fault"))).toBeVisible({ timeout: 20_000 });
      await expect(task.locator(".run-output")).toContainText(/Not yet: |Error/);
      const solution = await task.evaluate((box) => box.nextElementSibling.querySelector("code").textContent);
      await write(page, solution, task);
      await button.click();
      await expect(verdict, await task.getAttribute("id")).toHaveText(/^Right: /, { timeout: 20_000 });
    }
    if (tasks.length > 0) solved.push([chapter, `${tasks.length} of ${tasks.length}`]);
  }
  expect(solved.length).toBeGreaterThan(5);
  await page.goto(`${library}/progress.html`);
  await expect(page.locator(".progress thead th")).toHaveText(["Chapter", "Questions solved", "Tasks solved", "Goals reached"]);
  for (const [chapter, share] of solved) {
    await expect(page.locator(`tr[data-quiz="${chapter}"] .tasks`)).toHaveText(share);
  }
  await page.getByRole("button", { name: "Forget my progress" }).click();
  await expect(page.locator('tr[data-quiz="epipolar"] .tasks')).toHaveText("0 of 2");
});

test("the button changes to the JavaScript, runs it, and Reset brings the book's back", async ({ page, library }) => {
  await page.goto(`${library}/epipolar.html`);
  await expect(button(page)).toHaveText("Run in JavaScript", { useInnerText: true });
  await button(page).click();
  await expect(page.locator("html")).toHaveAttribute("data-listing", "js");
  await expect(button(page)).toHaveText("Run", { useInnerText: true });
  const printed = listing(page).locator(".listing-part[data-tab=js] .prints");
  await expect(status(page)).toHaveText(/^Done in/);
  await expect(printed).toBeHidden();
  await run(page, 'console.log("mine", [1, 2.5, -0], { a: "b" }, new Float64Array(2));');
  await expect(output(page)).toHaveText('mine [ 1, 2.5, -0 ] { a: "b" } Float64Array(2) [ 0, 0 ]');
  // Kept for the next visit, until it is reset.
  await page.reload();
  await button(page).click();
  await expect(output(page)).toHaveText(/^mine/);
  await listing(page).getByRole("button", { name: "Reset" }).click();
  await expect(printed).toBeVisible();
  await expect(listing(page).locator(".cm-content")).toContainText("@epipole/vision");
  await page.reload();
  await button(page).click();
  await expect(status(page)).toHaveText(/^Done in/);
  await expect(output(page)).not.toHaveText(/mine/);
});

test("keys run it, and Tab leaves the editor", async ({ page, library }) => {
  await open(page, library);
  await write(page, 'console.log("by keys");');
  await page.keyboard.press("Control+Enter");
  await expect(output(page)).toHaveText("by keys");
  await page.keyboard.press("Tab");
  await expect(listing(page).getByRole("button", { name: "Reset" })).toBeFocused();
});

test("mistakes are named with their line", async ({ page, library }) => {
  await open(page, library);
  for (const [code, says] of [
    ["let a = 1;\nlet b = ;", /SyntaxError in line 2: /],
    ["function f(", /SyntaxError in line 1: /],
    ["let a = 1;\nlet a = 2;", /SyntaxError/],
    ["console.log(1);\n\nnothing(2);", /ReferenceError in line 3: nothing is not defined/],
    ["const own = 1;\nthrow new RangeError('own words');", /RangeError in line 2: own words/],
    ["setTimeout(() => nothing(), 5);\nawait new Promise((done) => setTimeout(done, 500));", /ReferenceError in line 1/],
    ["Promise.reject(new Error('nobody waits'));\nawait new Promise((done) => setTimeout(done, 500));", /Error in line 1: nobody waits/],
    ['import lodash from "lodash";', /in line 1: "lodash" cannot be imported here/],
    ['const other = await import("./page.js");', /in line 1: import\(…\) is not available here/],
    [`${HEAD}await vision.fitHomography([[NaN, 0], [1, 0], [1, 1], [0, 1]], [[0, 0], [2, 0], [2, 2], [0, 2]]);`, /RangeError in line 3: pixels1 contains NaN in row 0/],
    [`${HEAD}const gone = new Float64Array(8);\nstructuredClone(gone, { transfer: [gone.buffer] });\nawait vision.fitHomography(gone, gone);`, /TypeError in line 5: pixels1 is detached/],
    [`${HEAD}const signal = AbortSignal.abort();\nawait vision.estimateHomography([[0, 0]], [[0, 0]], { signal });`, /AbortError/],
    [`${HEAD}vision.close();\nawait vision.transfer([1, 0, 0, 0, 1, 0, 0, 0, 1], [[1, 2]]);`, /Error in line 4: this Vision is closed/],
    ["new Float64Array(1e12);", /RangeError in line 1/],
    ['show("a word");', /TypeError in line 1: show wants an image/],
    ["plot([1, 2], [3]);", /RangeError in line 1: plot wants as many x as y, not 2 and 1/],
    ['figure("nothing");', /RangeError in line 1: there is no figure "nothing" here/],
  ]) {
    await run(page, code);
    await expect(output(page).locator(".run-fault"), code).toHaveText(says);
  }
  // The page goes on.
  await run(page, `${HEAD}console.log(await vision.transfer([1, 0, 0, 0, 1, 0, 0, 0, 1], [[1, 2]]));`);
  await expect(output(page)).toHaveText("Float64Array(2) [ 1, 2 ]");
});

test("the button on an error leads to its line", async ({ page, library }) => {
  await open(page, library);
  await run(page, "const a = 1;\nconst b = nothing;");
  await expect(listing(page).locator(".cm-faulty")).toHaveText("const b = nothing;");
  await output(page).getByRole("button", { name: "line 2" }).click();
  await page.keyboard.press("End");
  await page.keyboard.type(" // here");
  await expect(listing(page).locator(".cm-content")).toContainText("nothing; // here");
});

test("code that does not end is stopped by the reader", async ({ page, library }) => {
  await open(page, library);
  for (const code of ['while (true) console.log("on and on");', "await new Promise(() => {});"]) {
    await write(page, code);
    await button(page).click();
    await expect(status(page)).toHaveText("Still running after five seconds. Stop ends it.", { timeout: 10_000 });
    await expect(button(page)).toHaveText("Stop", { useInnerText: true });
    await button(page).click();
    await expect(status(page)).toHaveText("Stopped.");
  }
  await write(page, 'while (true) console.log("on and on");');
  await button(page).click();
  await expect(output(page)).toContainText("more than 1000 lines");
  await button(page).click();
});

test("code reaches neither the page nor what the book keeps", async ({ page, library, complaints }) => {
  await open(page, library);
  await run(page, "console.log(typeof document, typeof localStorage, typeof indexedDB, typeof caches, typeof Worker, typeof navigator.storage);");
  await expect(output(page)).toHaveText("undefined undefined undefined undefined undefined undefined");
  for (const code of ['eval("1 + 1");', 'new Function("return 1")();']) {
    await run(page, code);
    await expect(output(page).locator(".run-fault")).toHaveText(/EvalError in line 1/);
  }
  await run(page, 'await fetch("https://example.org/").catch(() => console.log("refused"));');
  await expect(output(page)).toHaveText("refused");
  // The browser reports each refusal.
  complaints.length = 0;
});

test("images, plots and tables appear with words for those who do not see them", async ({ page, library }) => {
  await open(page, library);
  await run(
    page,
    `show({ width: 16, height: 12, data: Uint8Array.from({ length: 192 }, (_, i) => i) }, { title: "ramp", points: [[3, 3]], lines: [[1, -1, 0]] });
plot([0, 1, 2, 3], [0, 1, 4, 9], { title: "squares", xLabel: "n", yLabel: "n²" });
console.table([{ a: 1, b: 2 }, { a: 3 }]);`,
  );
  await expect(output(page).getByRole("img", { name: "ramp, 16×12 pixels" })).toBeVisible();
  await expect(output(page).getByRole("img", { name: /^squares: n² from 0.00 to 9.00 over n from 0.00 to 3.00$/ })).toBeVisible();
  await expect(output(page).locator("tbody tr")).toHaveText(["012", "13"]);
});

test("axe finds nothing wrong with editor, output and errors, light or dark", async ({ page, library, complaints }) => {
  await open(page, library);
  await run(page, 'console.log("a line");\nconsole.table([{ a: 1 }]);\nplot([1, 2, 3]);\nnothing();');
  await expect(output(page).locator(".run-fault")).toBeVisible();
  for (const colorScheme of ["light", "dark"]) {
    await page.emulateMedia({ colorScheme });
    expect(complaints).toEqual([]);
    await test.step(colorScheme, () => expectAccessible(page));
    // axe copies elements of the editor with their style attributes, which the policy refuses.
    complaints.length = 0;
  }
});

test("code reads the figure above it, moves it, and draws into it", async ({ page, library }) => {
  await open(page, library);
  await run(
    page,
    `${HEAD}const fig = figure("epipolar-click");
await fig.set({ baseline: 0.3, forward: 0 });
const { pixels1, pixels2, fundamental } = fig.data;
const lines = await vision.epipolarLine2(fundamental, pixels1);
let worst = 0;
pixels2.forEach(([u, v], i) => {
  const [a, b, c] = lines.subarray(3 * i);
  worst = Math.max(worst, Math.abs(a * u + b * v + c) / Math.hypot(a, b));
});
await fig.draw({ panel: "second", points: pixels2, lines });
const photo = await fig.photograph("first");
console.log(fig.state.baseline, worst < 1e-9, photo.width, photo.height, photo.data.length);`,
  );
  await expect(output(page)).toHaveText("0.30 true 640 480 921600");
  const drawn = page.locator("#fig-epipolar-click epipole-figure .drawn");
  await expect(drawn.locator("path.color")).toHaveAttribute("d", /^M.*L.*a5 5/);
  await run(page, 'await figure("epipolar-click").clear();');
  await expect(drawn.locator("path")).toHaveCount(0);
  await run(page, 'await figure("epipolar-click").draw({ panel: "third", points: [[1, 2]] });');
  await expect(output(page).locator(".run-fault")).toHaveText(/RangeError|Error in line 1: the figure has no panel "third": it has first, second/);
});

test("a link brings code along, and does not run it", async ({ page, library, context, browserName }) => {
  if (browserName === "chromium") await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  await open(page, library);
  await write(page, 'console.log("from a friend: ü, 点");');
  await listing(page).getByRole("button", { name: "Copy link" }).click();
  await expect(status(page)).toHaveText("The link is copied.");
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(link).toContain("#run=line&code=d");
  await page.evaluate(() => localStorage.clear());
  await page.goto("about:blank");
  await page.goto(link);
  await expect(listing(page).locator(".cm-content")).toContainText("from a friend");
  await expect(status(page)).toHaveText("This code came with the link. Read it, then run it.");
  await expect(output(page)).toBeEmpty();
  await button(page).click();
  await expect(output(page)).toHaveText("from a friend: ü, 点");
  await page.goto("about:blank");
  await page.goto(link.slice(0, -9));
  await expect(listing(page).locator(".run-fault")).toHaveText("The code in this link is damaged or longer than 100,000 characters.");
});

test("names of the package are completed and explained", async ({ page, library }) => {
  await open(page, library);
  await write(page, HEAD);
  await page.keyboard.press("Control+End");
  await page.keyboard.type("vision.estimateFund");
  const options = listing(page).getByRole("option");
  await expect(options.first()).toHaveText("estimateFundamental");
  await expect(listing(page).locator(".cm-completionInfo")).toContainText("pixels1: Points2");
  // The editor takes no key for a completion that has only just appeared.
  await page.waitForTimeout(200);
  await page.keyboard.press("Enter");
  await expect(listing(page).locator(".cm-content")).toContainText("vision.estimateFundamental");
});

test("a browser without workers or WebAssembly says so, and the page goes on", async ({ page, library }) => {
  await open(page, library);
  await page.evaluate(() => {
    globalThis.Kept = globalThis.Worker;
    delete globalThis.Worker;
  });
  await run(page, "console.log(1);");
  await expect(output(page).locator(".run-fault")).toHaveText(/^Error: this browser starts no worker for the code: /);
  await page.evaluate(() => (globalThis.Worker = globalThis.Kept));
  await run(page, `${HEAD.replace("\nconst", "\ndelete globalThis.WebAssembly;\nconst")}await vision.epipoles([1, 0, 0, 0, 1, 0, 0, 0, 0]);`);
  await expect(output(page).locator(".run-fault")).toHaveText(/WebAssembly is not available here/);
  await run(page, `${HEAD}const other = await Promise.all([Vision.load(), Vision.load()]);\nconsole.log(other.length);`);
  await expect(output(page)).toHaveText("2");
});

test("a site whose package cannot be loaded says so", async ({ page, library, complaints }) => {
  await page.route(/sandbox-/, (route) => route.abort());
  await page.goto(`${library}/epipolar.html`);
  await button(page).click();
  await expect(output(page).locator(".run-fault")).toHaveText(/Error: /);
  complaints.length = 0;
});
