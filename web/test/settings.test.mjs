// The reader's settings, without a browser: stored values are checked.

import assert from "node:assert/strict";
import { test } from "node:test";
import { parseSettings, VALUES } from "../book/settings.ts";

test("every value of every setting can be stored", () => {
  for (const [name, values] of Object.entries(VALUES)) {
    for (const value of values) assert.deepEqual(parseSettings(JSON.stringify({ [name]: value })), { [name]: value });
  }
});

test("unknown settings and values are left out", () => {
  for (const text of [null, "", "dark", "null", "3", "[]", '["dark"]', '{"theme":"sepia"}', '{"theme":["dark"]}', '{"colour":"dark"}']) {
    assert.deepEqual(parseSettings(text), {}, text);
  }
  const mixed = '{"theme":"dark","text":115,"face":"comic","__proto__":{"motion":"reduced"},"constructor":"more"}';
  assert.deepEqual(parseSettings(mixed), { theme: "dark" });
});
