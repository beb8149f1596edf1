// Operations of a page on running figures: choosing, gliding, renaming, moving, interrupting.

import { expect, expectAccessible, figures, gripOf, hear, heard, ready, settled, test, told } from "./fixtures.mjs";
import { holds, keepMemory } from "./measure.mjs";
import { loadBindings } from "./places.mjs";

const { Figure } = await loadBindings();
const snapshots = figures.map(({ name }) => [name, JSON.parse(new Figure(name).snapshot(720))]);
/** A figure with a long computation and a slider that is not folded. */
const patient = snapshots.find(
  ([, { waiting, controls }]) => waiting !== null && controls.some(({ kind, place }) => kind === "slider" && place === "first"),
)[0];
const [own] = snapshots.find(([, { photos }]) => photos.length > 0);

/** Ids of the visible parts of a kind beside the picture. */
const shown = (figure, kind) =>
  figure.evaluate((element, name) => {
    const all = [...element.shadowRoot.querySelectorAll(`[data-${name}]`)];
    return all.filter((part) => part.checkVisibility()).map((part) => part.dataset[name]);
  }, kind);

test.describe("choosing", () => {
  test("controls, readouts and goals show what a page names, and change at run time", async ({ page, open }) => {
    const figure = await open(page, ["ransac-race controls=outliers+run readouts=budget+inliers goals=none"]);
    expect((await shown(figure, "control")).sort()).toEqual(["outliers", "run"]);
    expect((await shown(figure, "readout")).sort()).toEqual(["budget", "inliers"].sort());
    await expect(figure.locator(".fold:visible")).toHaveCount(0);
    await expect(figure.locator(".challenges")).toBeHidden();
    expect((await told(figure)).state).toEqual({});
    await figure.evaluate((element) => element.setAttribute("controls", "none"));
    expect(await shown(figure, "control")).toEqual([]);
    await figure.evaluate((element) => element.setAttribute("controls", ""));
    expect(await shown(figure, "control")).toEqual([]);
    await figure.evaluate((element) => element.setAttribute("controls", "seed"));
    expect(await shown(figure, "control")).toEqual(["seed"]);
    const { controls } = JSON.parse(new Figure("ransac-race").snapshot(720));
    const { default: seed } = controls.find(({ id }) => id === "seed");
    await figure.locator("input[type=range]").focus();
    await page.keyboard.press("ArrowRight");
    await expect.poll(async () => (await told(figure)).state).toEqual({ seed: String(seed + 1) });
    await figure.evaluate((element) => {
      for (const name of ["controls", "readouts", "goals"]) element.removeAttribute(name);
    });
    expect((await shown(figure, "control")).length).toBeGreaterThan(3);
    await expect(figure.locator(".challenges")).toBeVisible();
    await figure.evaluate((element) => element.setAttribute("goals", "all"));
    await expect(figure.locator("[data-challenge]").last()).toBeVisible();
    await expect(figure.locator(".notice")).toBeHidden();
  });

  test("all goals are there once: one at hand, the others below it to choose from", async ({ page, open }) => {
    const figure = await open(page, ["ransac-race goals=all"]);
    const goals = JSON.parse(new Figure("ransac-race").snapshot(720)).challenges.map(({ goal }) => goal);
    const texts = () =>
      figure.evaluate((element) => {
        const all = [...element.shadowRoot.querySelectorAll(".goal-line .goal:not(.goal-room .goal), [data-challenge]")];
        return all.filter((part) => part.checkVisibility()).map((part) => part.textContent);
      });
    expect(await texts()).toEqual(goals);
    await figure.getByRole("button", { name: goals[2] }).click();
    expect(await texts()).toEqual([goals[2], goals[0], goals[1], goals[3]]);
    await expect(figure.locator(".goal-line")).toBeFocused();
    await page.keyboard.press("Tab");
    await expect(figure.getByRole("button", { name: "Hint" })).toBeFocused();
    await expectAccessible(page);
  });

  test("choosing photographs of one's own opens their inputs", async ({ page, open }) => {
    const figure = await open(page, ["harris"]);
    const inputs = figure.locator("#photos");
    await expect(inputs).toBeHidden();
    await figure.locator(".choice label", { hasText: "Your photograph" }).click();
    await expect(inputs).toBeVisible();
    await expect(figure.getByRole("button", { name: "Photographs" })).toHaveAttribute("aria-expanded", "true");
  });

  test("unknown names are told, in the figure and on the console, and the known ones shown", async ({ page, open }) => {
    const warnings = [];
    page.on("console", (message) => message.type() === "warning" && warnings.push(message.text()));
    const figure = await open(page, ["ransac-race controls=outliers+outlier readouts=need goals=some"]);
    const notice = figure.locator(".notice");
    await expect(notice).toContainText('no control "outlier" in this figure; it has outliers');
    await expect(notice).toContainText('no readout "need"');
    await expect(notice).toContainText("none, one or all");
    expect(await shown(figure, "control")).toEqual(["outliers"]);
    expect(warnings.length).toBe(3);
    await figure.evaluate((element) => {
      element.setAttribute("controls", "outliers");
      element.setAttribute("readouts", "budget");
      element.setAttribute("goals", "one");
    });
    await expect(notice).toBeHidden();
  });
});

test.describe("gliding", () => {
  const value = (figure, id) => figure.evaluate((element, name) => element.controlValue(name), id);

  test("it passes what lies between, ends exactly there, and marks what changed", async ({ page, open }) => {
    const figure = await open(page, ["epipolar-click"]);
    await page.locator("#before a").focus();
    await hear(figure, "epipole-change");
    const handle = await figure.evaluate((element) => element.shadowRoot.querySelector(".grip").dataset.handle);
    // With a fake clock, a busy browser draws as many frames as any.
    await page.clock.install();
    await page.clock.pauseAt(Date.now() + 10_000);
    const glide = figure.evaluate((element, id) => element.glide({ forward: 0.3, [id]: "200,220" }), handle);
    await page.clock.runFor(800);
    await page.clock.resume();
    await glide;
    const passed = (await heard(figure)).map(([, state]) => Number(state.forward));
    expect(passed.filter((at) => at > -0.4 && at < 0.3).length, "places on the way").toBeGreaterThan(2);
    expect(await value(figure, "forward")).toBe(0.3);
    expect((await told(figure)).state[handle]).toMatch(/^200(\.0)?,220/);
    expect(await figure.evaluate((element) => element.controlText("forward"))).toBe("0.30 m");
    await expect(figure.locator("[data-control=forward][data-changed]")).toHaveCount(1);
    await expect(figure.locator(`[data-handle="${handle}"][data-changed]`)).toHaveCount(1);
    await expect(figure.locator("[data-readout][data-changed]")).not.toHaveCount(0);
    await expect(figure.locator("[data-changed]")).toHaveCount(0);
    await expect(page.locator("#before a")).toBeFocused();
  });

  test("for a reader who wants no motion it is there at once", async ({ page, open }) => {
    await page.emulateMedia({ reducedMotion: "reduce" });
    const figure = await open(page, ["epipolar-click"]);
    await hear(figure, "epipole-change");
    await figure.evaluate((element) => element.glide({ forward: 0.3 }));
    expect((await heard(figure)).length).toBe(1);
    expect(await value(figure, "forward")).toBe(0.3);
  });

  test("a second one takes the first one's goal over, and both promises are kept", async ({ page, open }) => {
    const figure = await open(page, ["epipolar-click"]);
    await figure.evaluate(async (element) => {
      const first = element.glide({ forward: 0.3 });
      await new Promise((resolve) => setTimeout(resolve, 150));
      await Promise.all([first, element.glide({ baseline: 0.2 })]);
    });
    expect(await value(figure, "forward")).toBe(0.3);
    expect(await value(figure, "baseline")).toBe(0.2);
  });

  test("it opens a figure that is far away, waits for the module, and brings it into view", async ({ page, open }) => {
    await page.addInitScript(() => {
      addEventListener("DOMContentLoaded", () => (document.querySelector("figure").style.marginTop = "4000px"));
    });
    await page.route(/\.wasm$/, async (route) => {
      await new Promise((resolve) => setTimeout(resolve, 500));
      await route.continue();
    });
    const figure = await open(page, ["ransac-race"], { wait: false });
    await page.evaluate(() => customElements.whenDefined("epipole-figure"));
    await figure.evaluate((element) =>
      Promise.all([element.whenReady(), element.glide({ outliers: 0.6 }), element.glide({ outliers: 0.6, points: 40 })]),
    );
    expect((await told(figure)).state).toEqual({ outliers: "0.60", points: "40" });
    await expect(figure.locator("canvas")).toBeInViewport({ ratio: 0.99 });
  });

  test("while something is computed, and without any room, it comes to its end", async ({ page, open }) => {
    const figure = await open(page, [patient], { settle: false });
    const slider = snapshots.find(([name]) => name === patient)[1].controls.find(({ kind, place }) => kind === "slider" && place === "first");
    await figure.evaluate((element, [id, to]) => element.glide({ [id]: to }), [slider.id, slider.max]);
    expect(await value(figure, slider.id)).toBe(slider.max);
    await settled(figure);
    await page.evaluate(() => (document.querySelector("figure").style.display = "none"));
    await figure.evaluate((element, [id, to]) => element.glide({ [id]: to }), [slider.id, slider.min]);
    await page.evaluate(() => (document.querySelector("figure").style.display = ""));
    await expect.poll(() => value(figure, slider.id)).toBe(slider.min);
  });

  test("where there is no such figure it ends as well", async ({ page, open }) => {
    const figure = await open(page, ["no-such-figure"], { wait: false });
    await page.evaluate(() => customElements.whenDefined("epipole-figure"));
    await figure.evaluate((element) => element.glide({ outliers: 0.6 }));
    await expect(figure.locator(".notice")).toContainText("there is no figure");
  });

  test("in a hidden tab it is there at once", async ({ page, open }) => {
    await page.addInitScript(() => {
      Object.defineProperty(document, "hidden", { get: () => window.away === true });
      const real = requestAnimationFrame;
      window.requestAnimationFrame = (callback) => (window.away ? 0 : real(callback));
    });
    const figure = await open(page, ["ransac-race"]);
    await page.evaluate(() => (window.away = true));
    await figure.evaluate((element) => element.glide({ outliers: 0.6 }));
    expect(await value(figure, "outliers")).toBe(0.6);
  });

  test("a reader who takes hold of the figure ends it; what cannot be used is told", async ({ page, open }) => {
    const figure = await open(page, ["ransac-race"]);
    const slider = figure.locator("input[type=range]").first();
    await slider.focus();
    const done = figure.evaluate((element) => element.glide({ outliers: 0.9 }, { duration: 60_000 }));
    await page.waitForTimeout(300);
    await page.keyboard.press("ArrowLeft");
    await done;
    expect(await value(figure, "outliers")).toBeLessThan(0.8);
    await figure.evaluate((element) => element.glide({ outliers: 7, nothing: 3 }));
    await expect(figure.locator(".notice")).toContainText('"7" is not a value of outliers');
    await expect(figure.locator(".notice")).toContainText('no parameter "nothing"');
  });

  test("a goal that the beginning meets is reached once the reader has left it and come back", async ({ page, open }) => {
    const figure = await open(page, ["sift-descriptor turn=0 zoom=1 brighter=60"]);
    await hear(figure, "epipole-challenge");
    await settled(figure);
    const solved = () => figure.evaluate((element) => element.goals.filter(({ solved }) => solved).map(({ id }) => id));
    expect(await solved()).toEqual([]);
    await expect(figure.locator(".goal-line")).not.toHaveAttribute("data-solved", "");
    // Goals that the page reaches do not count, either.
    for (const brighter of [50, 0, 60, 0]) {
      await figure.evaluate((element, value) => element.apply({ brighter: value }), brighter);
      await settled(figure);
      expect(await solved()).toEqual([]);
    }
    const slider = figure.getByRole("slider", { name: "Brighten" });
    while ((await value(figure, "brighter")) < 60) await slider.press("ArrowRight");
    await settled(figure);
    expect(await solved()).toEqual(["light-only"]);
    expect((await heard(figure)).map(([, { id }]) => id)).toEqual(["light-only"]);
  });

  test("a goal is shown step by step, and ends when the reader takes over", async ({ page, open }) => {
    const figure = await open(page, ["ransac-race"]);
    await hear(figure, "epipole-change", "epipole-challenge");
    const show = figure.getByRole("button", { name: "Show how" });
    await show.click();
    await expect(figure.locator(".goal-line")).toContainText("Shown: ");
    await expect(figure.locator(".goal-line")).not.toHaveAttribute("data-solved", "");
    expect((await heard(figure)).filter(([type]) => type === "epipole-challenge").length).toBe(0);
    expect((await heard(figure)).filter(([type]) => type === "epipole-change").length).toBeGreaterThan(3);
    await expect(show).toBeVisible();
    await figure.getByRole("button", { name: "Next goal" }).click();
    await show.click();
    await expect(figure.getByRole("button", { name: "Stop", exact: true })).toBeVisible();
    await figure.getByRole("button", { name: "Stop", exact: true }).click();
    await expect(show).toBeVisible();
  });
});

test.describe("keys", () => {
  test("none that is pressed in a figure reaches the page, but Tab and those with Ctrl; Escape leaves", async ({ page, open }) => {
    const figure = await open(page, ["ransac-race"]);
    await page.evaluate(() => {
      window.keys = [];
      for (const type of ["keydown", "keypress", "keyup"]) {
        document.addEventListener(type, ({ key }) => window.keys.push(key));
      }
    });
    const { grip } = await gripOf(figure);
    for (const stop of [figure.locator("button.step"), figure.locator("input[type=range]").first(), grip]) {
      await stop.focus();
      for (const key of ["a", "b", ".", " ", "ArrowLeft", "PageDown", "Enter", "?"]) await page.keyboard.press(key);
    }
    expect(await page.evaluate(() => window.keys)).toEqual([]);
    await page.keyboard.press("Control+b");
    await page.keyboard.press("Shift+Tab");
    expect(await page.evaluate(() => new Set(window.keys).has("b") && window.keys.includes("Tab"))).toBe(true);
    await grip.focus();
    await page.keyboard.press("Escape");
    expect(await page.evaluate(() => document.activeElement === document.body)).toBe(true);
  });
});

test.describe("the life of an element", () => {
  test("a renamed figure has its own controls, goals and properties, and no old photograph", async ({ page, open }) => {
    const figure = await open(page, [own]);
    const bytes = await page.evaluate(async () => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [400, 300];
      canvas.getContext("2d").fillRect(50, 50, 100, 100);
      return canvas.toDataURL("image/png").split(",")[1];
    });
    const chosen = figure.locator("input[type=file]").first().setInputFiles({
      name: "a.png",
      mimeType: "image/png",
      buffer: Buffer.from(bytes, "base64"),
    });
    await figure.evaluate((element) => element.setAttribute("name", "ransac-race"));
    await chosen.catch(() => {});
    await ready(figure);
    await expect(figure.locator(".title")).toHaveText("The race");
    const { controls, challenges } = JSON.parse(new Figure("ransac-race").snapshot(720));
    const visible = controls.filter(({ place }) => place !== "hidden");
    await expect(figure.locator("[data-control]")).toHaveCount(visible.length);
    await expect(figure.locator("[data-challenge]")).toHaveCount(challenges.length);
    await expect(figure.locator(".notice")).toBeHidden();
    const old = snapshots.find(([name]) => name === own)[1].controls.find(({ id, kind }) => kind === "slider" && !controls.some((one) => one.id === id));
    expect(await figure.evaluate((element, id) => id in element, old.id)).toBe(false);
    expect(await figure.evaluate((element) => element.outliers)).toBe(0.4);
  });

  test("500 renames and 500 re-attachments leave memory and listeners level", async ({ page, open }) => {
    test.setTimeout(240_000);
    await keepMemory(page);
    const figure = await open(page, ["ransac-race"]);
    const rename = (times) =>
      figure.evaluate(async (element, count) => {
        const names = ["ransac-budget", "harris", "four-poses", "ransac-race"];
        for (let turn = 0; turn < count; turn += 1) {
          element.setAttribute("name", names[turn % names.length]);
          await element.whenReady();
        }
      }, times);
    const attach = (times) =>
      figure.evaluate(async (element, count) => {
        const home = element.parentElement;
        for (let turn = 0; turn < count; turn += 1) {
          element.remove();
          home.prepend(element);
          if (turn % 10 === 0) await new Promise((resolve) => requestAnimationFrame(resolve));
        }
      }, times);
    await rename(20);
    await attach(20);
    const before = await holds(page);
    await rename(500);
    await attach(500);
    const after = await holds(page);
    expect(after.listeners - before.listeners).toBeLessThanOrEqual(20);
    expect(after.nodes - before.nodes).toBeLessThanOrEqual(200);
    expect(after.wasm - before.wasm).toBeLessThanOrEqual(1 << 20);
    expect(after.heap - before.heap).toBeLessThanOrEqual(4 << 20);
  });

  test("glides that had nowhere to scroll to wait for no end of it", async ({ page, open }) => {
    await page.emulateMedia({ reducedMotion: "no-preference" });
    const figure = await open(page, ["ransac-race"]);
    // The picture exceeds the window, so it never fits and there is nowhere to scroll.
    await page.setViewportSize({ width: 700, height: 180 });
    await figure.evaluate((element) => {
      addEventListener("scrollend", (event) => event.stopImmediatePropagation(), true);
      scrollBy(0, element.shadowRoot.querySelector(".picture").getBoundingClientRect().top + 20);
    });
    const glide = (times) =>
      figure.evaluate(async (element, count) => {
        for (let turn = 0; turn < count; turn += 1) await element.glide({ outliers: 0.1 * (turn % 5) }, { duration: 20 });
      }, times);
    await glide(1);
    const before = await holds(page);
    await glide(6);
    expect((await holds(page)).listeners).toBeLessThanOrEqual(before.listeners);
  });

  test("a figure that has just said that its link is copied goes with its name", async ({ page, open, context }) => {
    await context.grantPermissions(["clipboard-read", "clipboard-write"]);
    const figure = await open(page, ["ransac-budget"]);
    // Click by script: the browser keeps a reference to the last element pressed by mouse.
    await figure.getByRole("button", { name: "Copy link" }).evaluate((button) => button.click());
    await expect(figure.getByRole("button", { name: "Copied" })).toBeVisible();
    const gone = await figure.evaluateHandle(async (element) => {
      const root = new WeakRef(element.shadowRoot.querySelector(".root"));
      element.setAttribute("name", "four-poses");
      await element.whenReady();
      return root;
    });
    const devtools = await page.context().newCDPSession(page);
    for (let round = 0; round < 3; round += 1) await devtools.send("HeapProfiler.collectGarbage");
    expect(await gone.evaluate((root) => root.deref() === undefined)).toBe(true);
  });

  test("Reset starts a computation again that was stopped", async ({ page, open }) => {
    for (const name of ["ransac-epipolar", "two-view-sfm"]) {
      let hold = true;
      await page.route(/epipole-jobs.*\.wasm$/, async (route) => {
        while (hold) await new Promise((resolve) => setTimeout(resolve, 50));
        await route.continue();
      });
      const figure = await open(page, [name], { settle: false });
      await figure.evaluate((element) => element.flush());
      await expect(figure.locator(".root")).toHaveAttribute("aria-busy", "true");
      await figure.locator(".job").getByRole("button", { name: "Stop" }).click();
      await expect(figure.locator(".job")).toContainText("stopped");
      await expect(figure.locator("[aria-busy]")).toHaveCount(0);
      hold = false;
      await figure.getByRole("button", { name: "Reset", exact: true }).click();
      await settled(figure);
      await expect(figure.locator(".job")).toBeHidden();
      expect(await figure.evaluate((element) => Object.keys(element.readouts).length)).toBeGreaterThan(0);
      await page.unroute(/epipole-jobs.*\.wasm$/);
    }
  });

  test("moved in the page while it runs, it goes on", async ({ page, open }) => {
    const figure = await open(page, ["ransac-race outliers=0.8"]);
    await figure.locator("button.run").click();
    await figure.evaluate((element) => {
      document.querySelector("main").append(element);
      element.scrollIntoView();
    });
    await hear(figure, "epipole-readout");
    await expect.poll(async () => (await heard(figure)).length).toBeGreaterThan(2);
  });

  test("renamed out of the page, it opens when it is back", async ({ page, open }) => {
    const figure = await open(page, ["ransac-race"]);
    await figure.evaluate((element) => {
      const place = element.parentElement;
      element.remove();
      element.setAttribute("name", "ransac-budget");
      place.append(element);
    });
    await ready(figure);
    await expect(figure.locator(".title")).toHaveText(figures.find(({ name }) => name === "ransac-budget").title);
  });

  test("in 200 px, and in a row that gives it none, it has room and overflows nothing", async ({ page, open }) => {
    const figure = await open(page, ["eight-point"]);
    await page.evaluate(() => (document.querySelector("figure").style.width = "200px"));
    await expect.poll(() => figure.locator("canvas").evaluate((canvas) => canvas.clientWidth)).toBeLessThan(200);
    const outside = () =>
      figure.evaluate((element) => {
        const edge = element.getBoundingClientRect().right;
        const parts = [...element.shadowRoot.querySelectorAll("*")].filter((part) => part.checkVisibility() && !part.closest(".marks, .spoken, .help"));
        return parts.filter((part) => part.getBoundingClientRect().right > edge + 0.5).map((part) => part.outerHTML.slice(0, 100));
      });
    await expect.poll(outside).toEqual([]);
    await page.evaluate(() => Object.assign(document.querySelector("figure").style, { width: "", display: "flex" }));
    await expect.poll(() => figure.evaluate((element) => element.clientWidth)).toBeGreaterThan(200);
    await expect.poll(() => figure.locator("canvas").evaluate((canvas) => canvas.clientWidth)).toBeGreaterThan(150);
  });

  test("another density of pixels is followed every time", async ({ page, open }) => {
    // A window that moves to another screen, simulated: its density queries stop matching.
    await page.addInitScript(() => {
      window.density = 1;
      const lists = [];
      const real = window.matchMedia;
      window.matchMedia = (query) => {
        if (!query.includes("resolution")) return real.call(window, query);
        const list = Object.assign(new EventTarget(), { media: query });
        lists.push(list);
        return list;
      };
      Object.defineProperty(window, "devicePixelRatio", { get: () => window.density });
      window.moveTo = (density) => {
        const before = window.density;
        window.density = density;
        for (const list of lists) {
          if (list.media.includes(`${before}dppx`)) list.dispatchEvent(new Event("change"));
        }
      };
    });
    const figure = await open(page, ["ransac-race"]);
    const density = () => figure.locator("canvas").evaluate((canvas) => canvas.width / canvas.clientWidth);
    for (const wanted of [2, 1, 1.5, 2, 1]) {
      await page.evaluate((next) => window.moveTo(next), wanted);
      await expect.poll(density).toBeCloseTo(wanted, 1);
    }
  });

  test("full screen fills the screen", async ({ page, open }) => {
    await page.setViewportSize({ width: 1280, height: 720 });
    const figure = await open(page, ["ransac-race"]);
    await figure.getByRole("button", { name: "Full screen" }).click();
    await expect.poll(() => figure.evaluate((element) => document.fullscreenElement === element)).toBe(true);
    await expect.poll(() => figure.locator("canvas").evaluate((canvas) => canvas.clientHeight)).toBeGreaterThan(540);
    const inputs = await figure.locator(".panel > .inputs").boundingBox();
    expect(inputs.y + inputs.height).toBeLessThanOrEqual(await page.evaluate(() => innerHeight));
  });
});

test.describe("slow and large", () => {
  test("of two photographs the one that was chosen last counts; refusals name its own size; Reset forgets", async ({ page, open }) => {
    const figure = await open(page, [own]);
    const picture = (width, height) =>
      page.evaluate(([across, down]) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [across, down];
        const context = canvas.getContext("2d");
        for (let at = 0; at < 200; at += 1) {
          context.fillStyle = `hsl(${at * 37} 60% 50%)`;
          context.fillRect((at * 97) % across, (at * 61) % down, across / 9, down / 9);
        }
        return canvas.toDataURL("image/png").split(",")[1];
      }, [width, height]);
    const input = figure.locator("input[type=file]").first();
    const choose = async (name, data) => input.setInputFiles({ name, mimeType: "image/png", buffer: Buffer.from(data, "base64") });
    const [huge, small] = [await picture(6000, 5000), await picture(320, 240)];
    const note = figure.locator(".photo .note").first();
    await choose("huge.png", huge);
    await choose("small.png", small);
    await expect(note).toContainText("320 × 240 pixels.");
    await page.waitForTimeout(2500);
    await expect(note).toContainText("320 × 240 pixels.");
    await figure.getByRole("button", { name: "Reset", exact: true }).click();
    await expect(note).toHaveText("Or drop one here. Stays on your device.");
    await choose("strip.png", await picture(8, 3000));
    await expect(figure.locator(".notice")).toContainText("8 × 3000");
    // Wide enough originally, but too narrow when downscaled.
    await choose("strip.png", await picture(64, 3000));
    await expect(figure.locator(".notice")).toContainText(/64 × 3000 pixels, made smaller to \d+ × \d+\. This figure takes/);
    await expect(note).toHaveText("Or drop one here. Stays on your device.");
  });

  test("a JPEG file that is cut off is told as such, whatever the browser makes of it", async ({ page, open }) => {
    const figure = await open(page, [own]);
    const data = await page.evaluate(() => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [320, 240];
      const context = canvas.getContext("2d");
      for (let at = 0; at < 200; at += 1) {
        context.fillStyle = `hsl(${at * 37} 60% 50%)`;
        context.fillRect((at * 97) % 320, (at * 61) % 240, 36, 27);
      }
      return canvas.toDataURL("image/jpeg").split(",")[1];
    });
    const whole = Buffer.from(data, "base64");
    const input = figure.locator("input[type=file]").first();
    const choose = (name, buffer) => input.setInputFiles({ name, mimeType: "image/jpeg", buffer });
    const [note, notice] = [figure.locator(".photo .note").first(), figure.locator(".notice")];
    for (const share of [0.3, 0.6, 0.95]) {
      await choose(`cut-${share}.jpg`, whole.subarray(0, Math.floor(share * whole.length)));
      await expect(notice).toContainText(`cut-${share}.jpg is cut off: the file ends before its picture does.`);
      await expect(note).toHaveText("Or drop one here. Stays on your device.");
    }
    // The thumbnail has an end marker of its own; trailing data does not matter.
    const thumbnail = Buffer.concat([Buffer.from([0xff, 0xe1, 0, 8]), Buffer.from([0xff, 0xd8, 1, 2, 0xff, 0xd9])]);
    const head = (bytes) => Buffer.concat([bytes.subarray(0, 2), thumbnail, bytes.subarray(2)]);
    await choose("head.jpg", head(whole.subarray(0, whole.length / 2)));
    await expect(notice).toContainText("head.jpg is cut off");
    await choose("trailer.jpg", Buffer.concat([head(whole), Buffer.alloc(999, 7)]));
    await expect(note).toContainText("320 × 240 pixels.");
  });
});
