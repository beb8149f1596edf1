// 3D figures: rotating, panning and zooming by mouse, keys and fingers.

import { Buffer } from "node:buffer";
import { expect, figures, layoutWidth, listen, ready, settled, test, told } from "./fixtures.mjs";
import { loadBindings } from "./places.mjs";

test.use({ shared: true });

const { Figure } = await loadBindings();
const spaces = figures
  .map(({ name }) => [name, JSON.parse(new Figure(name).snapshot(760)).spaces[0]])
  .filter(([, space]) => space);

test("there are spaces to test", () => {
  expect(spaces.map(([name]) => name)).toContain("two-view-sfm");
});

/** Screen position of a relative position in the panel of a 3D scene. */
async function inSpace(figure, name, space, across, down) {
  const canvas = figure.locator("canvas");
  const room = await canvas.evaluate((element) => element.closest(".picture").clientWidth - 24);
  const { layout } = JSON.parse(new Figure(name).snapshot(layoutWidth(room)));
  const { rect } = layout.panels.find(({ id }) => id === space.panel);
  const box = await canvas.boundingBox();
  const scale = box.width / layout.width;
  return [
    box.x + scale * (rect.x + across * rect.width),
    box.y + scale * (rect.y + down * rect.height),
  ];
}

/**
 * Handles inside a 3D scene: their projections change with the view, so they are part of the state.
 */
const STANDING = { "epipolar-plane": ["point", "camera1", "camera2"] };

const zoomOf = async (figure, space) => Number((await told(figure)).state[space.zoom] ?? 1);

for (const [name, space] of spaces) {
  test.describe(name, () => {
    test("a drag from anywhere in the panel turns it, with Shift it moves", async ({ page, open }) => {
      const figure = await open(page, [name]);
      const changed = async () => {
        const keys = Object.keys((await told(figure)).state);
        return keys.filter((key) => !STANDING[name]?.includes(key)).sort();
      };
      const [x, y] = await inSpace(figure, name, space, 0.85, 0.5);
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x - 60, y + 20, { steps: 3 });
      await page.mouse.up();
      await expect.poll(changed).toEqual([space.orbit]);
      await page.keyboard.down("Shift");
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x - 30, y + 20, { steps: 3 });
      await page.mouse.up();
      await page.keyboard.up("Shift");
      await expect.poll(changed).toEqual([space.orbit, space.pan].sort());
      await figure.getByText("More settings").click();
      await figure.getByRole("button", { name: "Reset viewpoint" }).click();
      await expect.poll(async () => (await told(figure)).state).toEqual({});
    });

    test("the wheel scrolls the page; with Ctrl it enlarges", async ({ page, open }) => {
      const figure = await open(page, [name]);
      await figure.locator("canvas").scrollIntoViewIfNeeded();
      await page.evaluate(() => scrollTo(0, 0));
      const [x, y] = await inSpace(figure, name, space, 0.5, 0.3);
      await page.mouse.move(x, y);
      await page.keyboard.down("Control");
      await page.mouse.wheel(0, -100);
      await page.keyboard.up("Control");
      await expect.poll(() => zoomOf(figure, space)).toBeGreaterThan(1);
      expect(await page.evaluate(() => scrollY)).toBe(0);
      const zoom = await zoomOf(figure, space);
      await page.mouse.wheel(0, 100);
      await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(0);
      expect(await zoomOf(figure, space)).toBe(zoom);
    });

    test("plus and minus enlarge it, and Tab leaves it", async ({ page, open }) => {
      const figure = await open(page, [name]);
      const grip = figure.locator(`[data-handle="${space.orbit}"]`);
      await grip.focus();
      await page.keyboard.press("+");
      await expect.poll(() => zoomOf(figure, space)).toBeGreaterThan(1);
      // Faster than frames: each press counts.
      await grip.evaluate((element) => {
        for (let press = 0; press < 2; press += 1) {
          element.dispatchEvent(new KeyboardEvent("keydown", { key: "-", bubbles: true }));
        }
      });
      await expect.poll(() => zoomOf(figure, space)).toBeLessThan(1);
      await page.keyboard.press("Tab");
      await expect(figure.locator(`[data-handle="${space.pan}"]`)).toBeFocused();
      // Tab past the remaining handles and out.
      const left = await figure.evaluate((element, pan) => {
        const grips = [...element.shadowRoot.querySelectorAll(".grip")];
        return grips.length - grips.findIndex((grip) => grip.dataset.handle === pan);
      }, space.pan);
      for (let press = 0; press < left; press += 1) await page.keyboard.press("Tab");
      expect(await figure.locator(".grip:focus").count()).toBe(0);
    });

    test("two fingers enlarge it, one scrolls the page", async ({ browser, open, complaints }) => {
      const context = await browser.newContext({
        viewport: { width: 360, height: 640 },
        deviceScaleFactor: 2,
        hasTouch: true,
        isMobile: true,
      });
      const page = await context.newPage();
      listen(page, complaints);
      const figure = await open(page, [name]);
      // Scroll the scene to the upper part of the window, with room to scroll either way.
      const [, below] = await inSpace(figure, name, space, 0.5, 0.2);
      await page.evaluate((y) => scrollBy(0, y - 150), below);
      const [x, y] = await inSpace(figure, name, space, 0.5, 0.2);
      const touch = await context.newCDPSession(page);
      const send = (type, ...points) =>
        touch.send("Input.dispatchTouchEvent", {
          type,
          touchPoints: points.map(([px, py], id) => ({ x: px, y: py, id })),
        });
      const scroll = await page.evaluate(() => scrollY);
      await send("touchStart", [x - 20, y], [x + 20, y]);
      for (const spread of [30, 40, 50]) await send("touchMove", [x - spread, y], [x + spread, y]);
      await send("touchEnd");
      await expect.poll(() => zoomOf(figure, space)).toBeGreaterThan(1.5);
      expect(await page.evaluate(() => scrollY), "two fingers do not scroll").toBe(scroll);
      const { state } = await told(figure);
      expect(Object.keys(state)).not.toContain(space.orbit);

      await send("touchStart", [x, y]);
      for (let step = 1; step <= 10; step += 1) await send("touchMove", [x, y + 12 * step]);
      await send("touchEnd");
      await expect.poll(() => page.evaluate(() => scrollY)).toBeLessThan(scroll);
      expect((await told(figure)).state).toEqual(state);
      await context.close();
    });
  });
}

/** The JPEG with an Exif block that contains a focal length. */
function withFocal(jpeg, millimeters) {
  const block = Buffer.alloc(52);
  block.write("Exif\0\0II*\0", 0, "latin1");
  block.writeUInt32LE(8, 10);
  block.writeUInt16LE(1, 14);
  const entry = (at, tag, kind, value) => {
    block.writeUInt16LE(tag, at);
    block.writeUInt16LE(kind, at + 2);
    block.writeUInt32LE(1, at + 4);
    block.writeUInt32LE(value, at + 8);
  };
  entry(16, 0x8769, 4, 26);
  block.writeUInt16LE(1, 32);
  entry(34, 0xa405, 3, millimeters);
  const marker = Buffer.alloc(4);
  marker.writeUInt16BE(0xffe1, 0);
  marker.writeUInt16BE(block.length + 2, 2);
  return Buffer.concat([jpeg.subarray(0, 2), marker, block, jpeg.subarray(2)]);
}

test("one's own photographs bring their focal length, or it is guessed", async ({ page, open }) => {
  const figure = await open(page, ["two-view-sfm"]);
  const url = await page.evaluate(() => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [400, 300];
    const context = canvas.getContext("2d");
    for (let index = 0; index < 400; index += 1) {
      context.fillStyle = `hsl(${(index * 67) % 360} 60% ${20 + ((index * 29) % 60)}%)`;
      context.fillRect((index * 97) % 380, (index * 61) % 280, 7 + (index % 13), 7 + (index % 9));
    }
    return canvas.toDataURL("image/jpeg", 0.9);
  });
  const jpeg = Buffer.from(url.split(",")[1], "base64");
  const put = (index, buffer) =>
    figure
      .locator("input[type=file]:not([capture])")
      .nth(index)
      .setInputFiles({ name: "desk.jpg", mimeType: "image/jpeg", buffer });
  const words = async () => (await told(figure)).readouts.lens;
  await put(0, jpeg);
  await expect.poll(words).toContain("a guess");
  await expect.poll(async () => (await told(figure)).description).toContain("now choose photograph 2");
  await put(1, withFocal(jpeg, 28));
  // 28 mm · √(400² + 300²) / (√(36² + 24²) · 400) = 0.81, on the slider 0.80.
  await expect.poll(words).toContain("0.80 (29 mm), from the file");
  await ready(figure);
  await settled(figure);
  // The same picture twice: the camera did not move.
  await expect.poll(async () => (await told(figure)).description).toContain("did not move");
});
