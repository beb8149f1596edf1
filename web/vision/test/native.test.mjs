// Compares every function with native results, bit for bit.
//
// $EPIPOLE_NATIVE is the file that the example `js_native` of crates/epipole-js writes.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { FUNCTIONS } from "../dist/api.js";
import { Vision } from "../dist/index.js";

const ARRAYS = { Float64Array, Float32Array, Int32Array, Uint32Array, Uint8Array };

/** The value that a program wrote: arrays as bytes, so that all bits are kept. */
function read(value) {
  if (value === null || typeof value !== "object") return value;
  if (Array.isArray(value)) return value.map(read);
  const [[kind, content]] = Object.entries(value);
  if (kind === "record") return Object.fromEntries(Object.entries(content).map(([key, part]) => [key, read(part)]));
  const bytes = Uint8Array.from(Buffer.from(content, "hex")).buffer;
  return kind === "number" ? new Float64Array(bytes)[0] : new ARRAYS[kind](bytes);
}

const calls = JSON.parse(readFileSync(process.env.EPIPOLE_NATIVE, "utf8"));

/** Compares all calls with their native results. */
async function compare(vision) {
  for (const { name, given, result, fault } of calls) {
    const call = vision[name](...given.map(read));
    if (fault) {
      const [kind, message] = fault;
      const problem = await call.then(() => assert.fail(`${name} must fail`), (error) => error);
      assert.equal(problem.message, message);
      assert.equal(problem.code ?? problem.name, kind);
    } else {
      // Strict equality of -0 and NaN is that of Object.is; payloads of NaN do not reach JavaScript.
      assert.deepStrictEqual(await call, read(result), name);
    }
  }
}

test("every function gives the same bits as natively", async () => {
  await compare(await Vision.load());
  const called = new Set(calls.map(({ name }) => name));
  assert.deepEqual(Object.keys(FUNCTIONS).filter((name) => !called.has(name)), []);
});

test("a worker with all functions in one module gives the same bits", async () => {
  const vision = await Vision.load({ worker: true, parts: ["all"] });
  await compare(vision);
  vision.close();
});
