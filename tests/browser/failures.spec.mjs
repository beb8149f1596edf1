// Failures in a figure: a message in the figure, its poster stays, and other figures keep working.

import { expect, hear, heard, plain, ready, test, told } from "./fixtures.mjs";

const name = plain;

test("an unknown figure is named together with those that exist", async ({ page, open }) => {
  const both = await open(page, ["no-such-figure", name], { wait: false });
  const [unknown, known] = [both.nth(0), both.nth(1)];
  await expect(unknown.locator(".notice")).toContainText('there is no figure "no-such-figure"');
  await expect(unknown.locator(".notice")).toContainText(name);
  await expect(page.getByRole("img", { name: "Poster of no-such-figure" })).toBeVisible();
  await ready(known);
});

test("bad parameters are named, and the figure goes on without them", async ({ page, open }) => {
  const warnings = [];
  page.on("console", (message) => message.type() === "warning" && warnings.push(message.text()));
  const plain = await open(page, [name]);
  const defaults = await told(plain);
  const slider = await plain.evaluate((element) => {
    const input = element.shadowRoot.querySelector("input[type=range]");
    return { id: input.id.replace("control-", ""), max: Number(input.max) };
  });
  for (const value of [String(slider.max + 1000), "many", "NaN", "Infinity", "1e999", ""]) {
    warnings.length = 0;
    const figure = await open(page, [`${name} ${slider.id}=${value} sizee=3`]);
    const notice = figure.locator(".notice");
    await expect(notice).toBeVisible();
    await expect(notice).toContainText(`"${value}" is not a value of ${slider.id}`);
    await expect(notice).toContainText('no parameter "sizee"');
    expect(warnings.length).toBe(2);
    expect(await told(figure)).toEqual(defaults);
  }

  // The same from the page's address.
  const more = `&fig-1.${slider.id}=many&fig-1.sizee=3`;
  const figure = await open(page, [name], { more });
  await expect(figure.locator(".notice")).toContainText('"many" is not a value');
  await expect(figure.locator(".notice")).toContainText('no parameter "sizee"');
  expect(await told(figure)).toEqual(defaults);

  // Without the figure's key, unknown parameters are ignored.
  const strange = await open(page, [name], { more: "&utm_source=letter" });
  await expect(strange.locator(".notice")).toBeHidden();
});

test("a figure without room waits until it has some", async ({ page, open }) => {
  await page.addInitScript(() => {
    addEventListener("DOMContentLoaded", () => {
      document.querySelector("figure").style.display = "none";
    });
  });
  const figure = await open(page, [name], { wait: false });
  await page.waitForFunction(() => customElements.get("epipole-figure"));
  await expect(figure).not.toHaveAttribute("data-ready");
  await page.evaluate(() => {
    document.querySelector("figure").style.display = "";
    document.querySelector("figure").style.width = "0";
  });
  await expect(figure).not.toHaveAttribute("data-ready");
  await page.evaluate(() => (document.querySelector("figure").style.width = "500px"));
  await ready(figure);
  await page.evaluate(() => (document.querySelector("figure").style.width = "0"));
  await page.evaluate(() => (document.querySelector("figure").style.width = "30px"));
  const slider = figure.locator("input[type=range]").first();
  await slider.evaluate((input) => {
    input.value = input.min;
    input.dispatchEvent(new Event("input"));
  });
  await page.evaluate(() => (document.querySelector("figure").style.width = "600px"));
  await expect(figure.locator(".notice")).toBeHidden();
  await expect.poll(() => figure.locator("canvas").evaluate((canvas) => canvas.width)).toBeGreaterThan(500);
});

test("a panic stops one figure, Reset starts it again, and the other goes on", async ({
  page,
  open,
  complaints,
}) => {
  // Trap inside the module's own drawing function, as a real one would.
  await page.addInitScript(() => {
    const real = WebAssembly.instantiate;
    WebAssembly.instantiate = async (...args) => {
      const instance = await real(...args);
      const exports = { ...instance.exports };
      exports.figure_draw = (...given) => {
        if (window.trap) throw new WebAssembly.RuntimeError("unreachable");
        return instance.exports.figure_draw(...given);
      };
      // The generated script checks the instance's type.
      return Object.create(WebAssembly.Instance.prototype, { exports: { value: exports } });
    };
  });
  const both = await open(page, [name, name]);
  await ready(both.nth(1));
  await ready(both.nth(0));
  const [first, second] = [both.nth(0), both.nth(1)];
  const start = await told(first);
  await hear(first, "epipole-error");
  const slider = first.locator("input[type=range]").first();
  await slider.focus();
  await page.evaluate(() => (window.trap = true));
  await page.keyboard.press("ArrowRight");
  await expect(first.locator(".notice")).toContainText("stopped");
  await page.evaluate(() => (window.trap = false));
  expect(await heard(first)).toEqual([["epipole-error", { message: expect.stringContaining("unreachable") }]]);
  expect(complaints.length).toBeGreaterThan(0);
  complaints.length = 0;
  // The last good frame stays.
  await expect(first.locator("canvas")).toBeVisible();
  await page.keyboard.press("ArrowRight");

  await second.locator("input[type=range]").first().focus();
  await page.keyboard.press("ArrowRight");
  expect((await told(second)).state).not.toEqual({});

  await first.getByRole("button", { name: "Reset", exact: true }).click();
  await expect(first.locator(".notice")).toBeHidden();
  await expect.poll(() => told(first)).toEqual(start);
  await slider.focus();
  await page.keyboard.press("ArrowRight");
  await expect.poll(async () => (await told(first)).state).not.toEqual({});
});
