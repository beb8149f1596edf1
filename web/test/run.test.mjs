// Readers' code, without a browser: printed values, imports, mistakes, links, names.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { inspect } from "../run/inspect.ts";
import { methodsOf } from "../run/names.ts";
import { packed, unpacked } from "../run/packing.ts";
import { firstMistake, prepare } from "../run/source.ts";

const ADDRESSES = { sandbox: "https://book/sandbox.js", vision: "https://book/vision/index.js" };

test("values are printed as code would write them", () => {
  const circle = { name: "c" };
  circle.self = circle;
  for (const [value, text] of [
    ["as it is", "as it is"],
    [["in a list"], '[ "in a list" ]'],
    [-0, "-0"],
    [NaN, "NaN"],
    [undefined, "undefined"],
    [null, "null"],
    [12n, "12n"],
    [[], "[]"],
    [{}, "{}"],
    [{ a: [1, 2.5], b: { c: true } }, "{ a: [ 1, 2.5 ], b: { c: true } }"],
    [new Float64Array([1, 2]), "Float64Array(2) [ 1, 2 ]"],
    [new Map([["k", 1]]), 'Map(1) [ [ "k", 1 ] ]'],
    [new RangeError("too far"), "RangeError: too far"],
    [Math.max, "[Function: max]"],
    [circle, '{ name: "c", self: [Circular] }'],
    [{ a: { b: { c: { d: { e: 1 } } } } }, "{ a: { b: { c: { d: [Object] } } } }"],
  ]) {
    assert.equal(inspect(value), text);
  }
  const long = inspect(Array.from({ length: 150 }, (_, index) => index));
  assert.ok(long.endsWith("... 50 more\n]"), long);
  assert.ok(Math.max(...long.split("\n").map(({ length }) => length)) <= 76);
});

test("the package is the only import, and lines stay where they are", () => {
  const code = 'import { Vision } from "@epipole/vision";\nconst text = "import x from \'y\'";\n';
  const { text, shift } = prepare(code, ADDRESSES, { harris: { state: {} } });
  const lines = text.split("\n");
  assert.ok(lines[0].slice(shift).startsWith(`import { Vision } from "${ADDRESSES.vision}";`), lines[0]);
  assert.ok(lines[0].includes('epipole_begin({"harris":{"state":{}}})'));
  assert.equal(lines[1], code.split("\n")[1]);
  assert.equal(lines.at(-1), ";epipole_finish();");
  for (const [line, column, bad] of [
    [1, 15, 'import x from "lodash";'],
    [2, 17, '\nexport * from   "./page.js";'],
    [1, 8, 'import "@epipole/figures";'],
    [1, 15, 'const m = await import("@epipole/vision");'],
  ]) {
    const fault = prepare(bad, ADDRESSES, {});
    assert.equal(fault.name, "ImportError", bad);
    assert.equal(fault.line, line, bad);
    if (!bad.includes("await")) assert.equal(fault.column, column, bad);
  }
});

test("a check is the body of a function behind the code", async () => {
  const { text } = prepare("const answer = 41;", ADDRESSES, {}, 'return answer === 42 ? "Right." : "Not yet.";');
  const own = text.replace(/^import \{.*?\} from "[^"]*";/, "const epipole_begin = () => {};const epipole_finish = (v) => { globalThis.said = v; };");
  await import(`data:text/javascript,${encodeURIComponent(own)}`);
  assert.equal(globalThis.said, "Not yet.");
});

test("mistakes of syntax have a place and a reason", () => {
  const place = ({ line, column, message }) => [line, column, message];
  assert.deepEqual(place(firstMistake("let a = 1;\nlet b = ;")), [2, 9, "unexpected ;"]);
  const open = firstMistake("function f(");
  assert.equal(open.message, "the code ends too early: a bracket or a quote is open");
  assert.match(firstMistake("let a = 1;\nlet a = 2;").message, /declared twice/);
});

test("code survives a link, and damaged links are refused", async () => {
  for (const code of ["", "console.log('ü, 点');\n".repeat(200), "a\0b"]) assert.equal(await unpacked(await packed(code)), code);
  const link = await packed("console.log(1);".repeat(50));
  assert.match(link, /^d[\w-]+$/);
  for (const bad of [link.slice(0, -7), "d!!", "x", `d${"A".repeat(40)}`]) {
    await assert.rejects(unpacked(bad), /damaged or longer/, bad);
  }
  await assert.rejects(unpacked(await packed("x".repeat(100_001))), /damaged or longer/);
});

test("every function of the package has a signature and documentation", () => {
  const api = readFileSync(new URL("../../web/vision/src/api.ts", import.meta.url), "utf8");
  const methods = methodsOf(api);
  const [, table] = /FUNCTIONS[^=]*= \{\n([\s\S]*?)\n\};/.exec(api);
  const names = [...table.matchAll(/^ {2}(\w+):/gm)].map(([, name]) => name);
  assert.deepEqual(methods.map(({ name }) => name), names);
  for (const { name, signature, docs } of methods) {
    assert.ok(signature.startsWith(`${name}(`), signature);
    assert.ok(docs.length > 10 && !docs.includes("*"), `${name}: ${docs}`);
  }
});
