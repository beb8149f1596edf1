// Monkey test: seeded random pointer input, keys, sizes, attributes and moves on every figure.
// Nothing may break, and a fresh figure in the same state must give the same readouts. The page
// must stay responsive and not leak memory.
//
// `MONKEY_SECONDS` is the duration per figure, `SEED` the random seed: `make monkey SEED=7`.

import { expect, figures, listen, ready, settled, test, told } from "./fixtures.mjs";
import { holds, keepMemory, tasksOf } from "./measure.mjs";

const SECONDS = Number(process.env.MONKEY_SECONDS ?? 1);
const SEED = Number(process.env.SEED ?? 1);
const KEYS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "PageUp", "PageDown", "Home", "End", "Enter", " ", "Tab", "Delete", "+", "-", "a", "Escape"];
const ODD = ["NaN", "1e999", "-1e999", "", "true", "ό—", "0.5", "3", "-7", "١٢", "1,2", "null", "1e-320"];
const SIZES = [[1280, 720], [390, 844], [320, 568], [1920, 1080], [700, 400]];

/** Park and Miller's generator. */
function generator(seed) {
  let state = (seed % 2147483646) + 1;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** Resizes the window, leaving full screen first, as keys may have entered it. */
async function resize(page, width, height) {
  await page.evaluate(() => (document.fullscreenElement ? document.exitFullscreen() : undefined));
  await page.setViewportSize({ width, height });
}

/** Random actions on a figure, `[weight, name, action]`. */
function deeds(page, figure, random) {
  const pick = (list) => list[Math.floor(random() * list.length)];
  const place = async () => {
    const box = (await figure.locator(".picture").boundingBox()) ?? { x: 0, y: 0, width: 1, height: 1 };
    const { width, height } = page.viewportSize();
    return [Math.min(box.x + random() * box.width, width - 1), Math.min(box.y + random() * box.height, height - 1)];
  };
  const control = () =>
    figure.evaluate((element, share) => {
      const all = [...element.shadowRoot.querySelectorAll("input, select, button, .grip, .crosshair, summary")];
      const some = all.filter((one) => one.checkVisibility() && one.type !== "file" && !/save|full screen/i.test(one.textContent));
      some[Math.floor(share * some.length)]?.focus();
    }, random());
  const list = [
    [6, "click", async () => page.mouse.click(...(await place()))],
    [
      6,
      "drag",
      async () => {
        await page.mouse.move(...(await place()));
        await page.mouse.down();
        for (let step = 0; step < 3; step += 1) await page.mouse.move(...(await place()), { steps: 2 });
        // Sometimes the button is not released.
        if (random() < 0.9) await page.mouse.up();
      },
    ],
    [
      10,
      "keys",
      async () => {
        await control();
        for (let press = 0; press < 4; press += 1) await page.keyboard.press(pick(KEYS));
      },
    ],
    [2, "wheel", async () => page.mouse.wheel(random() * 200 - 100, random() * 400 - 200)],
    [1, "size", () => resize(page, pick(SIZES)[0], pick(SIZES)[1])],
    [
      3,
      "attribute",
      () =>
        figure.evaluate(
          (element, [share, value]) => {
            const names = [...element.shadowRoot.querySelectorAll("[name]")].map(({ name }) => name.replace(/^.*[.]/, ""));
            const known = Object.keys(element.state).concat(names, "nonsense", "theme", "controls", "goals");
            const name = known[Math.floor(share * known.length)];
            if (/^[a-z][\w-]*$/.test(name) && name !== "name") element.setAttribute(name, value);
          },
          [random(), pick(ODD)],
        ),
    ],
    [1, "theme", () => page.emulateMedia({ colorScheme: pick(["light", "dark"]), reducedMotion: pick(["reduce", "no-preference"]) })],
    [
      1,
      "move",
      () =>
        figure.evaluate((element) => {
          const { parentNode, nextSibling } = element;
          element.remove();
          parentNode.insertBefore(element, nextSibling);
        }),
    ],
    [
      1,
      "rename",
      () =>
        figure.evaluate(async (element, other) => {
          const name = element.getAttribute("name");
          element.setAttribute("name", other);
          element.setAttribute("name", name);
        }, pick(figures).name),
    ],
    [1, "reset", () => figure.evaluate((element) => element.reset())],
    [1, "glide", () => figure.evaluate((element, state) => void element.glide(state, { duration: 80 }), { nonsense: pick(ODD) })],
  ];
  const all = list.reduce((sum, [weight]) => sum + weight, 0);
  return () => {
    let at = random() * all;
    return list.find(([weight]) => (at -= weight) < 0) ?? list[0];
  };
}

/** Resets the figure with a new engine, freeing the previous one. Returns the memory held. */
async function begin(page, figure) {
  await figure.evaluate(async (element) => {
    const name = element.getAttribute("name");
    for (const { name: key } of [...element.attributes]) if (!/^(name|data-.*)$/.test(key)) element.removeAttribute(key);
    element.setAttribute("name", "ransac-budget");
    await element.whenReady();
    element.setAttribute("name", name);
  });
  await ready(figure);
  await expect(figure.locator("[aria-busy]")).toHaveCount(0, { timeout: 90_000 });
  await settled(figure);
  // Replace the browser's references to the last pressed element and drop target.
  await page.mouse.click(1, 1);
  await page.getByRole("link", { name: "a link" }).dragTo(page.getByRole("heading", { name: "Figures" }));
  return holds(page);
}

for (const [index, { name }] of figures.entries()) {
  test(`${name} bears ${SECONDS} s of anything`, async ({ page, open, context, browser, complaints }) => {
    test.setTimeout(120_000 + 4000 * SECONDS);
    await keepMemory(page);
    const random = generator(1000 * SEED + index);
    let figure = await open(page, [name], { settle: false });
    // Allocate memory for the largest possible picture first.
    await resize(page, 1920, 1080);
    await ready(figure);
    await figure.evaluate((element) => element.toPng().then(() => undefined));
    await resize(page, 1000, 900);
    const before = await begin(page, figure);
    const next = deeds(page, figure, random);
    const done = [];
    const end = Date.now() + 1000 * SECONDS;
    let middle;
    const tasks = await tasksOf(browser, page);
    while (Date.now() < end || done.length < 25) {
      const [, what, act] = next();
      done.push(what);
      await act();
      if (Date.now() > end - 500 * SECONDS) middle ??= await page.evaluate(() => window.memory.buffer.byteLength);
    }
    const { p99, longest } = await tasks.end();
    await page.mouse.up();
    test.info().annotations.push({ type: "deeds", description: String(done.length) });
    await resize(page, 1000, 900);
    await expect(figure, done.slice(-12).join(", ")).toHaveAttribute("data-ready", "");
    await expect(figure.locator(".notice")).not.toContainText("mistake of ours");
    // Stop animations before comparing.
    const pause = figure.getByRole("button", { name: "Pause", exact: true });
    if (await pause.count()) await pause.first().evaluate((button) => button.click());
    const goOn = figure.getByRole("button", { name: "Go on", exact: true });
    if (await goOn.count()) await goOn.first().evaluate((button) => button.click());
    await figure.dispatchEvent("pointerenter");
    // Leftover photographs and settings may take long to compute.
    await expect(figure.locator("[aria-busy]")).toHaveCount(0, { timeout: 90_000 });
    await settled(figure);
    const known = await told(figure);
    expect(JSON.stringify(known)).not.toMatch(/NaN|Infinity|undefined/);
    expect(p99, "of a hundred tasks the longest but one, milliseconds").toBeLessThanOrEqual(50);
    expect(longest, "the longest task, milliseconds").toBeLessThanOrEqual(200);

    // Before opening a second page, as both may be counted together.
    let after = await begin(page, page.locator("epipole-figure"));
    // A busy browser may free memory late; a real leak stays.
    for (let tries = 0; tries < 10 && after.listeners - before.listeners > 20; tries += 1) {
      await page.waitForTimeout(1000);
      after = await holds(page);
    }
    const more = Object.fromEntries(Object.keys(after).map((key) => [key, after[key] - before[key]]));
    test.info().annotations.push({ type: "cost", description: JSON.stringify({ p99, longest, ...more }) });
    expect(more.listeners, "listeners").toBeLessThanOrEqual(20);
    expect(more.nodes, "nodes").toBeLessThanOrEqual(200);
    expect(more.heap, "bytes of scripts").toBeLessThanOrEqual(4 << 20);
    // WebAssembly memory never shrinks, so that of the largest picture stays.
    expect(more.wasm, "bytes of the module").toBeLessThanOrEqual(32 << 20);
    if (SECONDS >= 10) expect(after.wasm - middle, "bytes of the module since the middle").toBeLessThanOrEqual(10 << 20);

    const other = await context.newPage();
    listen(other, complaints);
    await other.setViewportSize({ width: 1000, height: 900 });
    figure = await open(other, [name]);
    await figure.evaluate((element, state) => element.restore(state), known.state);
    await ready(figure);
    await expect(figure.locator("[aria-busy]")).toHaveCount(0, { timeout: 90_000 });
    await settled(figure);
    expect(await told(figure)).toEqual(known);
    await other.close();
  });
}
