// Makes the pictures of README.md from the built book: `make pictures`.

import { chromium } from "@playwright/test";
import gifenc from "gifenc";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { PNG } from "pngjs";
import { launchOptions } from "./chromium.mjs";
import { book, root } from "./places.mjs";
import { serve } from "./server.mjs";

const { GIFEncoder, applyPalette, quantize } = gifenc;
/** Folder of the pictures. */
const FOLDER = join(root, "docs/images");
/** Frames of the moving picture, and the time that each is shown. */
const FRAMES = 36;
const FRAME_MS = 90;
/** Place in the palette of pixels that are as in the frame before. */
const UNCHANGED = 255;
/** A pointer, since browsers without a window draw none. */
const POINTER = `<svg xmlns="http://www.w3.org/2000/svg" width="22" height="28" viewBox="0 0 22 28"><path
  d="M1 1v21l5-5 4 9 4-2-4-9h7z" fill="#fff" stroke="#000" stroke-width="1.5"/></svg>`;
const POINTER_STYLE = "position: fixed; left: 0; top: 0; z-index: 9999; pointer-events: none";

const server = await serve({ mounts: { book }, policy: false });
const browser = await chromium.launch(launchOptions);
mkdirSync(FOLDER, { recursive: true });

async function ready(page, name) {
  const figure = page.locator(`epipole-figure[name="${name}"]`).first();
  await figure.scrollIntoViewIfNeeded();
  await figure.evaluate((element) => element.whenReady);
  await figure.hover();
  await page.waitForTimeout(1500);
  return figure;
}

async function pictureOfBook() {
  const page = await browser.newPage({ viewport: { width: 1200, height: 760 } });
  await page.goto(`${server.origin}/book/epipolar.html`);
  const figure = await ready(page, "epipolar-click");
  await figure.evaluate((element) => scrollTo(0, element.getBoundingClientRect().top + scrollY - 170));
  await page.waitForTimeout(500);
  writeFileSync(join(FOLDER, "book.png"), await page.screenshot());
  await page.close();
}

async function movingFigure() {
  const page = await browser.newPage({ viewport: { width: 640, height: 760 } });
  await page.goto(`${server.origin}/book/embed/epipolar-click.html`);
  const figure = await ready(page, "epipolar-click");
  await page.evaluate(([picture, style]) => {
    const pointer = document.createElement("div");
    pointer.id = "pointer";
    pointer.innerHTML = picture;
    // Set by script: the page's policy forbids styles in attributes.
    pointer.style.cssText = style;
    document.body.append(pointer);
  }, [POINTER, POINTER_STYLE]);
  await figure.locator("canvas:visible").waitFor();
  const canvas = await figure.locator("canvas:visible").boundingBox();
  const grip = await figure.locator(".grip").last().boundingBox();
  const clip = { x: 0, y: canvas.y - 8, width: 640, height: canvas.height + 16 };
  const [startX, startY] = [grip.x + grip.width / 2, grip.y + grip.height / 2];
  await page.mouse.move(startX, startY);
  await page.mouse.down();
  const gif = GIFEncoder();
  let palette, before;
  for (let frame = 0; frame < FRAMES; frame += 1) {
    // An ellipse, which ends where it begins.
    const angle = (2 * Math.PI * frame) / FRAMES;
    const x = startX + 0.1 * canvas.width * Math.sin(angle);
    const y = startY - 0.24 * canvas.height * (1 - Math.cos(angle));
    await page.mouse.move(x, y);
    await page.evaluate(([x, y]) => {
      document.querySelector("#pointer").style.transform = `translate(${x}px, ${y}px)`;
    }, [x, y]);
    await page.waitForTimeout(60);
    const { data, width, height } = PNG.sync.read(await page.screenshot({ clip }));
    palette ??= [...quantize(data, UNCHANGED), [0, 0, 0]];
    const pixels = applyPalette(data, palette.slice(0, UNCHANGED));
    // Only what changes is stored.
    const changes = pixels.map((color, index) => (before?.[index] === color ? UNCHANGED : color));
    const options = { palette, delay: FRAME_MS, transparent: true, transparentIndex: UNCHANGED, dispose: 1 };
    gif.writeFrame(changes, width, height, options);
    before = pixels;
  }
  await page.mouse.up();
  gif.finish();
  writeFileSync(join(FOLDER, "figure.gif"), gif.bytes());
  await page.close();
}

await pictureOfBook();
await movingFigure();
await browser.close();
await server.close();
