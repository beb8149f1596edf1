// Which pictures of a page are kept for reading offline.

import assert from "node:assert/strict";
import { test } from "node:test";
import { inVariant, variantOf } from "../offline/pictures.ts";

const picture = (name, width, theme) => `assets/figures/${name}-${width}-${theme}-0f.webp`;
const all = (name, ...widths) => widths.flatMap((width) => ["dark", "light"].map((theme) => picture(name, width, theme)));

test("a page keeps each picture in the width and theme that its reader sees, and everything else", () => {
  const groups = [all("two-view-sfm", 360, 720, 1088), ["assets/page-1.js"], [picture("cover", 360, "light")]];
  assert.deepEqual(inVariant(groups, { width: 720, theme: "dark" }), [
    picture("two-view-sfm", 720, "dark"),
    "assets/page-1.js",
    picture("cover", 360, "light"),
  ]);
});

test("a picture without that width is kept in the next smaller one, else in its smallest", () => {
  const groups = [all("harris", 360, 720), all("cover", 720, 1088)];
  const kept = (width) => inVariant(groups, { width, theme: "light" });
  assert.deepEqual(kept(1088), [picture("harris", 720, "light"), picture("cover", 1088, "light")]);
  assert.deepEqual(kept(360), [picture("harris", 360, "light"), picture("cover", 720, "light")]);
});

test("an address tells its variant", () => {
  const address = "https://example.org/course/assets/figures/two-view-sfm-360-light-4f.webp";
  assert.deepEqual(variantOf(address), { width: 360, theme: "light" });
  assert.equal(variantOf("https://example.org/course/assets/page-1.js"), undefined);
});
