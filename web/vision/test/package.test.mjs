// Tests the package itself: the examples of the README, its files, and their size.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants } from "node:zlib";

const folder = new URL("../", import.meta.url);
const read = (path) => readFileSync(new URL(path, folder));

/** Size as a server sends it, bytes. */
function brotli(...paths) {
  const params = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24 };
  return paths.map((path) => brotliCompressSync(read(path), { params }).length).reduce((sum, size) => sum + size);
}

const readme = read("README.md").toString();
const examples = [...readme.matchAll(/```js\n([\s\S]*?)```/g)].map(([, code]) => code);
for (const [index, code] of examples.entries()) {
  test(`example ${index + 1} of the README prints what it says`, () => {
    const expected = [...code.matchAll(/console\.log\(.*\/\/ (.*)/g)].map(([, text]) => text);
    assert.ok(expected.length > 0);
    const local = code.replace("@epipole/vision", new URL("dist/index.js", folder).href);
    const options = { timeout: 30_000, encoding: "utf8" };
    const out = execFileSync(process.execPath, ["--input-type=module", "-e", local], options);
    assert.deepEqual(out.trim().split("\n"), expected);
  });
}

test("the package contains scripts, modules, types and licenses, and no dependency", () => {
  const { dependencies } = JSON.parse(read("package.json"));
  assert.equal(dependencies, undefined);
  const pack = ["pack", "--dry-run", "--json", "--ignore-scripts"];
  const [{ files }] = JSON.parse(execFileSync("npm", pack, { cwd: fileURLToPath(folder), encoding: "utf8" }));
  const names = files.map(({ path }) => path);
  for (const name of ["index.js", "index.d.ts", "api.d.ts", "worker.js", "THIRD-PARTY.txt", "LICENSE-MIT", "LICENSE-APACHE"]) {
    assert.ok(names.includes(`dist/${name}`), name);
  }
  const scripts = names.filter((name) => name.endsWith(".js"));
  for (const name of scripts) {
    for (const [, path] of read(name).toString().matchAll(/(?:from|import|import\(|URL\() ?"(\.\/[^"]+)"/g)) {
      assert.ok(names.includes(new URL(path, `file:///${name}`).pathname.slice(1)), `${name} needs ${path}`);
    }
  }
});

test("a homography costs a page at most 90 KB, everything at most 450 KB", (t) => {
  const scripts = readdirSync(new URL("dist", folder)).filter((name) => name.endsWith(".js"));
  const own = brotli(...scripts.map((name) => `dist/${name}`));
  const parts = readdirSync(new URL("dist/parts", folder)).filter((name) => name.endsWith(".wasm"));
  const sizes = parts.map((name) => {
    const part = name.replace(".wasm", "");
    const size = brotli(`dist/parts/${name}`, `dist/parts/${part}.part.js`);
    t.diagnostic(`${part}: ${(size / 1000).toFixed(1)} KB`);
    const [, said] = new RegExp(`\\| \`${part}\` \\|.*\\| (\\d+) KB`).exec(readme) ?? [];
    assert.ok(Math.abs(size / 1000 - said) < 0.1 * said, `the README says ${said} KB for ${part}`);
    return [part, size];
  });
  const all = own + sizes.reduce((sum, [, size]) => sum + size, 0);
  t.diagnostic(`scripts: ${(own / 1000).toFixed(1)} KB; everything: ${(all / 1000).toFixed(1)} KB`);
  assert.ok(own + Object.fromEntries(sizes).homography <= 90_000);
  assert.ok(all <= 450_000);
});
