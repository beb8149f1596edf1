// Requirements for every figure of the gallery in a browser.

import { SLIDER, change, expect, expectAccessible, figures, gripOf, hear, heard, layoutWidth, listen, middle, ready, settled, snapshots, test, told } from "./fixtures.mjs";

test.use({ shared: true });

const controlsOf = new Map(snapshots.map(([name, { controls }]) => [name, controls]));

test("there are figures to test", () => {
  expect(figures.length).toBeGreaterThan(0);
});

/**
 * Figures with a handle constrained to a slanted line, which may move sideways under a vertical
 * drag.
 */
const SLANTED = ["same-picture"];

test("without script there are poster and caption", async ({ browser, site }) => {
  const context = await browser.newContext({ javaScriptEnabled: false });
  const page = await context.newPage();
  for (const { name } of figures) {
    await page.goto(`${site}/figures?figure=${name}`);
    await expect(page.getByRole("img", { name: `Poster of ${name}` })).toBeVisible();
    await expect(page.getByText(`Caption of ${name}.`)).toBeVisible();
  }
  await context.close();
});

for (const { name, title, help } of figures) {
  test.describe(name, () => {
    test("is drawn, operated, reset, saved, linked and accessible, alone and with another", async ({ page, open }) => {
      const figure = await open(page, [name]);
      const asked = await told(figure);
      const reset = async () => {
        await figure.getByRole("button", { name: "Reset", exact: true }).click();
        await expect.poll(() => told(figure)).toEqual(asked);
      };

      await test.step("draws its first frame and says what it is", async () => {
        const canvas = figure.locator("canvas");
        await expect(canvas).toBeVisible();
        await expect(figure.locator("slot").first()).toBeHidden();
        await expect(figure.locator(".title")).toHaveText(title);
        const root = figure.locator(".root");
        await expect(root).toHaveAccessibleName(title);
        await expect(root).toHaveAccessibleDescription(help);
        const { description } = await told(figure);
        await expect(canvas).toHaveAccessibleName(description);
        const colors = () =>
          canvas.evaluate((element) => {
            const { data } = element.getContext("2d").getImageData(0, 0, element.width, element.height);
            return new Set(new Uint32Array(data.buffer)).size;
          });
        await expect.poll(colors, { message: "different colors in the frame" }).toBeGreaterThan(8);
      });

      await test.step("the live region says what the figure shows, once it rests", async () => {
        const live = figure.locator("[aria-live]");
        await expect(live).toHaveCount(1);
        await expect(live).toHaveAttribute("aria-live", "polite");
        await expect(live).toHaveText("");
        await change(page, figure, 6);
        const { description } = await told(figure);
        // The last key may not have been handled yet.
        const says = () =>
          figure.evaluate((element) => {
            const { textContent } = element.shadowRoot.querySelector("[aria-live]");
            return textContent !== "" && textContent.includes(element.description);
          });
        await expect.poll(says, { message: description }).toBe(true);
      });

      await test.step("a native slider sets a parameter, with its value in words", async () => {
        const slider = figure.locator(SLIDER).first();
        if ((await slider.count()) === 0) return;
        await hear(figure, "epipole-change");
        await slider.focus();
        const before = await slider.getAttribute("aria-valuetext");
        await page.keyboard.press("ArrowRight");
        await expect(slider).not.toHaveAttribute("aria-valuetext", before);
        const words = await slider.getAttribute("aria-valuetext");
        await expect(figure.locator(".slider output").first()).toHaveText(words);
        await expect.poll(() => heard(figure)).not.toEqual([]);
      });

      await test.step("the keys alone reach and move everything", async () => {
        const grip = (await gripOf(figure))?.grip;
        const focused = () =>
          figure.evaluate((element) => {
            const at = element.shadowRoot.activeElement;
            return at && (at.dataset.handle ?? at.id ?? at.textContent);
          });
        // Tab visits every stop once, then leaves the figure.
        await page.locator("#before a").focus();
        const stops = [];
        for (let presses = 0; presses < 80; presses += 1) {
          await page.keyboard.press("Tab");
          const kind = await figure.evaluate((element) => {
            const at = element.shadowRoot.activeElement;
            return at ? at.getAttribute("role") ?? at.type ?? at.localName : null;
          });
          if (kind === null) break;
          stops.push(kind);
        }
        expect(stops.length).toBeLessThan(80);
        const has = async (native) => (await figure.locator(`${native}:visible`).count()) > 0;
        const native = (await has(SLIDER)) ? "range" : (await has("input[type=radio]")) ? "radio" : "select-one";
        // Figures that are only clicked have a crosshair instead of handles; some have neither.
        const held = (await figure.locator(".grip, .crosshair").count()) > 0 ? ["slider"] : [];
        expect(stops, "a handle, a native input and a button").toEqual(
          expect.arrayContaining([...held, native, "button"]),
        );
        if (!grip) return;

        await grip.focus();
        const id = await focused();
        const value = () => grip.getAttribute("aria-valuetext");
        const scroll = await page.evaluate(() => scrollY);
        const seen = new Set([await value()]);
        for (const key of ["ArrowRight", "ArrowUp", "PageDown", "PageUp", "Home", "End", "ArrowLeft"]) {
          await page.keyboard.press(key);
          await figure.evaluate((element) => element.flush());
          seen.add(await value());
        }
        expect(seen.size, "places that the keys reached").toBeGreaterThanOrEqual(3);
        expect(await focused()).toBe(id);
        expect(await page.evaluate(() => scrollY), "arrows do not scroll the page").toBe(scroll);
        await page.keyboard.press("Tab");
        expect(await focused()).not.toBe(id);
      });

      await test.step("Reset returns to what the page asks for", async () => {
        const grip = (await gripOf(figure))?.grip;
        await grip?.focus();
        if (grip) await page.keyboard.press("ArrowLeft");
        else await change(page, figure);
        expect(await told(figure)).not.toEqual(asked);
        await reset();
      });

      await test.step("parameters are properties of the element", async () => {
        const shown = controlsOf.get(name).filter(({ place }) => place !== "hidden");
        const control = shown.find(({ kind }) => kind === "slider") ?? shown.find(({ kind }) => kind === "choice");
        const { id, kind, max, min, value: before, options } = control;
        const other = kind === "slider" ? (before === max ? min : max) : options.find(([option]) => option !== before)[0];
        await figure.evaluate((element, [id, wanted]) => (element[id] = wanted), [id, other]);
        await figure.evaluate((element) => element.flush());
        expect(await figure.evaluate((element, id) => element[id], id)).toBe(other);
        expect(Object.keys((await told(figure)).state)).toContain(id);
        await reset();
      });

      await test.step("the picture is saved as a PNG at twice the size of its layout", async () => {
        const waiting = page.waitForEvent("download");
        await figure.getByRole("button", { name: "Save image" }).click();
        const download = await waiting;
        expect(download.suggestedFilename()).toBe(`${name}.png`);
        const chunks = [];
        for await (const chunk of await download.createReadStream()) chunks.push(chunk);
        const bytes = Buffer.concat(chunks);
        expect(bytes.subarray(1, 4).toString()).toBe("PNG");
        const room = await figure.locator(".picture").evaluate((picture) => picture.clientWidth - 32);
        expect(bytes.readUInt32BE(16)).toBe(2 * layoutWidth(room));
      });

      // From the place on the page where a fresh figure is.
      await page.evaluate(() => scrollTo(0, 0));
      await ready(figure);
      await test.step("a mouse drags a handle, and where it took hold stays", async () => {
        await hear(figure, "epipole-change", "epipole-readout");
        const at = await gripOf(figure);
        if (!at) return;
        await page.mouse.move(at.x + 4, at.y + 4);
        await page.mouse.down();
        // With several handles close by, the nearest is taken.
        const id = await figure.evaluate((element) => element.shadowRoot.activeElement.dataset.handle);
        const grip = figure.locator(`[data-handle="${id}"]`);
        const before = await grip.getAttribute("aria-valuetext");
        const from = await middle(grip);
        // Drag towards the center of the picture.
        const stage = await figure.locator("canvas").boundingBox();
        const away = (place, low, size) => (place < low + size / 2 ? 36 : -36);
        const [dx, dy] = [away(from.x, stage.x, stage.width), away(from.y, stage.y, stage.height)];
        await page.mouse.move(at.x + 4 + dx / 2, at.y + 4 + dy / 2);
        await page.mouse.move(at.x + 4 + dx, at.y + 4 + dy);
        await page.mouse.up();
        await expect.poll(() => heard(figure)).not.toEqual([]);
        expect(await grip.getAttribute("aria-valuetext")).not.toBe(before);
        const to = await middle(grip);
        const [movedX, movedY] = [to.x - from.x, to.y - from.y];
        // A handle may be constrained to a line or a range, but never jumps under the pointer.
        for (const [is, want] of [[movedX, dx], [movedY, dy]]) {
          if (!SLANTED.includes(name)) expect(is * Math.sign(want)).toBeGreaterThanOrEqual(-1.5);
          expect(Math.abs(is)).toBeLessThanOrEqual(Math.abs(want) + 1.5);
        }
        expect(movedX * dx + movedY * dy).toBeGreaterThan(0);
        expect(Math.hypot(movedX, movedY)).toBeGreaterThan(10);
      });

      await test.step("a permalink restores the state", async () => {
        await change(page, figure, 2);
        const grip = (await gripOf(figure))?.grip;
        await grip?.focus();
        for (const key of grip ? ["ArrowLeft", "ArrowDown"] : []) await page.keyboard.press(key);
        await settled(figure);
        const before = await told(figure);
        expect(Object.keys(before.state).length).toBeGreaterThan(0);
        const link = await figure.evaluate((element) => element.permalink);
        expect(link).toContain("#fig-1");

        await page.goto(link);
        await ready(figure);
        await expect.poll(() => told(figure)).toEqual(before);
        await expect(figure.locator(".notice")).toBeHidden();
      });

      await test.step("axe finds nothing wrong, light or dark", async () => {
        const wears = async (theme) => {
          await expect(figure.locator(".root")).toHaveAttribute("data-theme", theme);
          const isBright = () =>
            figure.locator("canvas").evaluate((canvas) => {
              const [red, green, blue] = canvas.getContext("2d").getImageData(1, 1, 1, 1).data;
              return red + green + blue > 384;
            });
          await expect.poll(isBright, "the picture wears the theme").toBe(theme === "light");
        };
        await page.emulateMedia({ colorScheme: "light" });
        await open(page, [name]);
        await wears("light");
        await figure.evaluate((element) => {
          for (const fold of element.shadowRoot.querySelectorAll("details")) fold.open = true;
          element.setAttribute("goals", "all");
        });
        await expectAccessible(page);
        await page.emulateMedia({ colorScheme: "dark" });
        await wears("dark");
        await expectAccessible(page, { colors: true });
        await page.emulateMedia({ colorScheme: "light" });
      });

      await test.step("two on a page keep to themselves", async () => {
        const both = await open(page, [name, name]);
        await ready(both.nth(1));
        await ready(both.nth(0));
        const idle = () => settled(both);
        await idle();
        const untouched = await told(both.nth(1));
        await change(page, both.nth(0));
        expect((await told(both.nth(0))).state).not.toEqual({});
        await idle();
        expect(await told(both.nth(1))).toEqual(untouched);
        const link = await both.nth(0).evaluate((element) => element.permalink);
        expect(link).toMatch(/[?&]fig-1\./);
        const first = await told(both.nth(0));
        await page.goto(link);
        await ready(both.nth(0));
        await ready(both.nth(1));
        await expect.poll(() => told(both.nth(0))).toEqual(first);
        await expect.poll(() => told(both.nth(1))).toEqual(untouched);
      });
    });

    test("goes with a finger on a phone 360 px wide", async ({ browser, open, complaints }) => {
      const context = await browser.newContext({
        viewport: { width: 360, height: 740 },
        deviceScaleFactor: 3,
        hasTouch: true,
        isMobile: true,
      });
      const page = await context.newPage();
      listen(page, complaints);
      const figure = await open(page, [name]);
      await test.step("a phone 360 px wide needs no sideways scroll", async () => {
        expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(360);
        const small = await figure.evaluate((element) => {
          const targets = element.shadowRoot.querySelectorAll("button, input[type=range], select, .toggle");
          return [...targets]
            .filter((target) => target.checkVisibility() && !target.closest(".chooser"))
            .map((target) => [target.textContent, target.getBoundingClientRect()])
            .filter(([, box]) => box.height < 44 || box.width < 44)
            .map(([text, box]) => `${text}: ${box.width} × ${box.height}`);
        });
        expect(small, "targets smaller than 44 px").toEqual([]);
        const canvas = figure.locator("canvas");
        // The first frame may not have been drawn yet.
        const off = () => canvas.evaluate((c) => Math.abs(c.width - 2 * c.clientWidth));
        await expect.poll(off, { message: "two device pixels to a CSS pixel at most" }).toBeLessThanOrEqual(2);
      });

      await test.step("a finger drags a handle, and scrolls the page from anywhere else", async () => {
        await figure.locator("canvas").scrollIntoViewIfNeeded();
        const at = await gripOf(figure);
        if (!at) return;
        const { grip, x, y } = at;
        const id = await grip.getAttribute("data-handle");
        const before = await grip.getAttribute("aria-valuetext");
        const scroll = await page.evaluate(() => scrollY);
        const stage = await figure.locator("canvas").boundingBox();
        const towards = (from, low, size) => (from < low + size / 2 ? 8 : -8);
        const [dx, dy] = [towards(x, stage.x, stage.width), towards(y, stage.y, stage.height)];
        const touch = await context.newCDPSession(page);
        const send = (type, ...points) =>
          touch.send("Input.dispatchTouchEvent", {
            type,
            touchPoints: points.map(([px, py]) => ({ x: px, y: py })),
          });
        await send("touchStart", [x, y]);
        for (let step = 1; step <= 5; step += 1) await send("touchMove", [x + step * dx, y + step * dy]);
        await send("touchEnd");
        const moved = figure.locator(`[data-handle="${id}"]`);
        await expect(moved).not.toHaveAttribute("aria-valuetext", before);
        expect(await page.evaluate(() => scrollY), "the page stays while a handle moves").toBe(scroll);

        const top = await page.evaluate(() => {
          scrollTo(0, 0);
          return scrollY;
        });
        const title = await figure.locator(".head").boundingBox();
        const start = Math.min(title.y + title.height / 2, 700);
        await send("touchStart", [100, start]);
        for (let step = 1; step <= 10; step += 1) await send("touchMove", [100, start - 15 * step]);
        await send("touchEnd");
        await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(top);
      });
      await context.close();
    });
  });
}
