// Picture, readouts and controls share the screen while in use, and nothing jumps.

import { expect, expectAccessible, figures, layoutWidth, listen, ready, settled, test } from "./fixtures.mjs";
import { prepare } from "./pages.mjs";
import { loadBindings } from "./places.mjs";

test.use({ shared: true });

const { Figure } = await loadBindings();

/** Parts that must be visible together. */
const CORE = [".sheet", ".under", ".panel > .main", ".panel > .inputs"];
const HIGHEST_PX = 640;
const SCREENS = [{ width: 1280, height: 720 }, { width: 1024, height: 768 }];
const PHONE = { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, hasTouch: true, isMobile: true };
/** A page 320 px wide; one of 1280 × 720 px enlarged to 200 %. */
const NARROW = { width: 320, height: 640 };
const ENLARGED = { viewport: { width: 640, height: 360 }, deviceScaleFactor: 2 };

/** Distance from the top of the highest to the bottom of the lowest of the parts, CSS pixels. */
function height(figure, parts) {
  return figure.evaluate((element, selectors) => {
    const boxes = selectors
      .map((selector) => element.shadowRoot.querySelector(selector))
      .filter((part) => part?.checkVisibility())
      .map((part) => part.getBoundingClientRect());
    return Math.max(...boxes.map(({ bottom }) => bottom)) - Math.min(...boxes.map(({ top }) => top));
  }, parts);
}

/** Layout width of a picture in a test page, from the width of the viewport. */
function widthOf(name, viewport) {
  const host = Math.min(viewport - 32, 1120);
  const { aspect } = JSON.parse(new Figure(name).snapshot(720));
  const beside = host >= 860 && aspect === "tall";
  const room = beside ? Math.min(747, host - 2 - 304) - 27 : host - 2 - (host >= 860 ? 30 : host <= 576 ? 24 : 32);
  return layoutWidth(room);
}

/**
 * Controls that hide part of the picture on a phone when focused. Runs in the page, as there are
 * many.
 */
function hiding(figure) {
  return figure.evaluate(async (element) => {
    document.body.style.paddingBottom = "1500px";
    const shown = () => {
      const box = element.shadowRoot.querySelector(".sheet").getBoundingClientRect();
      return (Math.min(box.bottom, innerHeight) - Math.max(box.top, 0)) / box.height > 0.999;
    };
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    const found = [];
    for (const control of element.shadowRoot.querySelectorAll(":is(.under, .panel) :is(input, select, button, summary)")) {
      if (!control.checkVisibility({ visibilityProperty: true })) continue;
      scrollTo(0, 0);
      control.focus();
      await frame();
      if (!shown()) found.push(control.outerHTML);
      // After scrolling on, the picture must be visible as long as the control is.
      for (const lower of [80, 160, 240]) {
        scrollBy(0, lower);
        const box = control.getBoundingClientRect();
        const hit = element.shadowRoot.elementFromPoint(box.x + box.width / 2, box.y + 2);
        if ((hit === control || control.contains(hit)) && !shown()) found.push(`${lower} px on: ${control.outerHTML}`);
      }
    }
    return found;
  });
}

/** Markup of a figure's stand-in and its surroundings. */
const TEXT = /<figure class="epipole"[^]*<\/figure>/;

/**
 * Renders a page's figure truncated at each of `cuts`, and names parts that are visible then at
 * another position than in the complete page.
 */
function strayed(page, text, cuts) {
  return page.evaluate(
    ({ text, cuts }) => {
      const main = document.querySelector("main");
      const sheets = document.querySelector("epipole-figure").shadowRoot.adoptedStyleSheets;
      const parts = (html) => {
        main.querySelector("figure").remove();
        main.insertAdjacentHTML("beforeend", "<div></div>");
        const room = main.lastElementChild;
        room.setHTMLUnsafe(html);
        room.replaceWith(...room.childNodes);
        const { shadowRoot } = main.querySelector("epipole-figure");
        shadowRoot.adoptedStyleSheets = sheets;
        return [...shadowRoot.querySelectorAll(".root, .root *:not(svg *, option)")];
      };
      const whole = parts(text).map((part) => part.getBoundingClientRect());
      const found = [];
      for (const cut of cuts) {
        for (const [index, part] of parts(text.slice(0, cut)).entries()) {
          const { x, y, width, height } = part.getBoundingClientRect();
          const then = whole[index];
          // Browsers count a layout shift from three pixels on.
          if (Math.max(Math.abs(x - then.x), Math.abs(y - then.y)) < 3) continue;
          if (width * height > 0 && part.checkVisibility({ visibilityProperty: true })) {
            found.push(`${part.className || part.localName} at ${x}, ${y}, later at ${then.x}, ${then.y}: ${text.slice(cut - 60, cut)}`);
          }
        }
      }
      return found;
    },
    { text, cuts },
  );
}

/** Keeps the layout shifts of the pages that follow in `window.shifts`. */
function watchShifts(page) {
  return page.addInitScript(() => {
    window.shifts = [];
    new PerformanceObserver((list) => {
      for (const { value, sources } of list.getEntries()) {
        window.shifts.push([value, ...sources.map(({ node }) => node?.className || node?.localName)]);
      }
    }).observe({ type: "layout-shift", buffered: true });
  });
}

/** Opens a figure with all folds open, and expects it within the width of the page. */
async function expectNoSidewaysScroll(page, open, name) {
  const figure = await open(page, [name]);
  await figure.evaluate((element) => {
    for (const fold of element.shadowRoot.querySelectorAll("details")) fold.open = true;
  });
  const { width } = page.viewportSize();
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(width);
  const outside = await figure.evaluate((element, edge) => {
    const all = [...element.shadowRoot.querySelectorAll("*")].filter((part) => part.checkVisibility());
    const out = (part) => part.getBoundingClientRect().right > edge && !part.closest(".marks, .spoken, .help");
    return all.filter(out).map((part) => part.outerHTML.slice(0, 120));
  }, width);
  expect(outside).toEqual([]);
}

/**
 * Opens a figure with its script held back, and expects its parts where the prerendered page has
 * them, and nothing wrong from axe. The page must watch its layout shifts.
 */
async function expectSamePlaces(page, open, name) {
  const { width } = page.viewportSize();
  // Hold back the script until the prerendered page has been measured.
  let release;
  const released = new Promise((resolve) => (release = resolve));
  const held = /\/elements\/.*\.js$/;
  await page.route(held, async (route) => {
    await released;
    await route.fallback();
  });
  const query = { wide: "1", poster: String(widthOf(name, width)) };
  const opened = open(page, [name], { query, wait: false });
  const figure = page.locator("epipole-figure");
  const root = figure.locator(".root");
  await expect(root).toHaveAttribute("aria-busy", "true");
  await expect(figure.locator("canvas")).toHaveCount(0);
  await expect.poll(() => root.evaluate((element) => getComputedStyle(element).borderStyle)).toBe("solid");
  const places = () =>
    figure.evaluate((element) => {
      const parts = [".root", ".sheet", ".main", ".panel > .inputs", ".challenges", ".folds"];
      return parts.map((part) => {
        const box = element.shadowRoot.querySelector(part)?.getBoundingClientRect();
        return box ? [box.y + scrollY, box.height] : [];
      });
    });
  // Posters are whole pixels high, pictures need not be.
  const expectSame = (now, then) => {
    const moved = now.flatMap((box, part) => box.map((at, index) => Math.abs(at - then[part][index])));
    expect(Math.max(...moved), JSON.stringify([then, now])).toBeLessThanOrEqual(1.01);
  };
  const before = await places();
  release();
  await opened;
  await page.unroute(held);
  await expect(figure).toHaveAttribute("data-ready", "");
  await expect(figure.locator("link")).toHaveCount(0);
  expectSame(await places(), before);
  await ready(figure);
  await expect(figure.locator("canvas")).toBeVisible();
  await settled(figure);
  expectSame(await places(), before);
  expect(await page.evaluate(() => window.shifts)).toEqual([]);
  await expectAccessible(page);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
  return figure;
}

for (const { name } of figures) {
  test.describe(name, () => {
    test("fits on one screen, and nothing moves as it comes or is shown", async ({ page, open }) => {
      prepare(name);
      await watchShifts(page);
      for (const { width, height: down } of SCREENS) {
        await test.step(`poster and living figure fill the same places of ${width} × ${down}, and axe finds nothing wrong`, async () => {
          await page.setViewportSize({ width, height: down });
          const figure = await expectSamePlaces(page, open, name);
          expect(await height(figure, CORE), `at ${width} × ${down}`).toBeLessThanOrEqual(HIGHEST_PX);
        });
      }

      await test.step("320 px wide, nothing has to be scrolled sideways", async () => {
        await page.setViewportSize(NARROW);
        await expectNoSidewaysScroll(page, open, name);
      });

      await test.step("what a page has brought of it so far stays where it is as the rest comes", async () => {
        const scripts = /\/elements\/.*\.js$/;
        await page.route(scripts, (route) => route.fulfill({ body: "", contentType: "text/javascript" }));
        for (const [width, height] of [[1280, 720], [700, 720], [390, 844]]) {
          await page.setViewportSize({ width, height });
          await open(page, [name], { query: { wide: "1", poster: String(widthOf(name, width)) }, wait: false });
          const text = (await page.evaluate(async () => (await fetch(location.href)).text())).match(TEXT)[0];
          const unstyled = text.replace(/<link[^>]*>/, "");
          const ends = [...unstyled.matchAll(/>/g)].map(({ index }) => index + 1);
          const inTree = ends.filter((end) => end > unstyled.indexOf("<template") && end < unstyled.indexOf("</template>"));
          expect(inTree.length).toBeGreaterThan(40);
          expect(await strayed(page, unstyled, inTree.filter((_, nth) => nth % 3 === 0)), `at ${width}`).toEqual([]);
        }
        await page.unroute(scripts);
      });

      await test.step("each goal is shown how to reach, without moving what is below the figure", async () => {
        await page.setViewportSize({ width: 1000, height: 900 });
        await page.emulateMedia({ reducedMotion: "reduce" });
        const figure = await open(page, [`${name} goals=all`]);
        const goals = await figure.locator("[data-challenge]").all();
        expect(goals.length).toBeGreaterThan(0);
        const height = async () => (await figure.boundingBox()).height;
        for (const goal of goals) {
          // The current goal is above the list.
          if (await goal.isVisible()) await goal.getByRole("button").click();
          const before = await height();
          await figure.getByRole("button", { name: "Show how" }).click();
          await expect(figure.locator(".goal-line .mark").first()).toHaveText(/^Shown: /);
          await expect(goal).not.toHaveAttribute("data-solved", "");
          await expect(figure.getByRole("button", { name: "Show how" })).toBeVisible();
          expect(Math.abs((await height()) - before)).toBeLessThan(1);
        }
      });
    });

    test("fits on a phone, and enlarged to 200 %", async ({ browser, open, complaints }) => {
      prepare(name);
      const pageOf = async (options) => {
        const context = await browser.newContext(options);
        const page = await context.newPage();
        listen(page, complaints);
        return page;
      };
      await test.step("poster and living figure fill the same places of a phone, and axe finds nothing wrong", async () => {
        const page = await pageOf(PHONE);
        await watchShifts(page);
        const figure = await expectSamePlaces(page, open, name);
        expect(await hiding(figure)).toEqual([]);
        await page.context().close();
      });

      await test.step("enlarged to 200 %, nothing has to be scrolled sideways", async () => {
        const page = await pageOf(ENLARGED);
        await expectNoSidewaysScroll(page, open, name);
        await page.context().close();
      });
    });
  });
}
