// The same calls give the same results and pixels natively and in WebAssembly.

import { expect, figures, test } from "./fixtures.mjs";
import { loadBindings } from "./places.mjs";
import { modulesAt, playInPage, playNatively, write } from "./scripts.mjs";

const { Figure } = await loadBindings();

const LOOKS = [
  { width: 760, scale: 1, theme: "light", seed: 1, rounds: 2 },
  { width: 360, scale: 2, theme: "dark", seed: 2, rounds: 2 },
  { width: 511, scale: 1.5, theme: "high-contrast", seed: 3, rounds: 3 },
];

test.describe.configure({ timeout: 600_000 });

for (const { name } of figures) {
  test(`${name} is the same natively and in the browser`, async ({ page, site }) => {
    const scripts = LOOKS.map((look) => write(Figure, name, look));
    const native = playNatively(scripts);
    await page.goto(`${site}/figures`);
    const browser = await page.evaluate(playInPage, { ...modulesAt(site), scripts });
    for (const [index, script] of scripts.entries()) {
      for (const [step, words] of script.calls.entries()) {
        const where = `script ${index}, call ${step}: ${words.join(" ")}`;
        expect(browser[index][step], where).toBe(native[index][step]);
      }
      const frames = new Set(native[index].filter((answer) => /^\d+ × \d+: [0-9a-f]{16}$/.test(answer)));
      expect(frames.size, "different frames").toBeGreaterThan(script.calls.length / 100);
      expect(frames.size).toBeGreaterThanOrEqual(3);
    }
  });
}
