// Builds the npm package in dist/: node web/vision/build.mjs [--modules] [--bindings DIR] [--out DIR]
//
// --bindings is the folder with the scripts and modules of the parts that `epipole-book vision` makes;
// --modules makes them first. Every source becomes a script of its own, so that bundlers find workers
// and modules by their addresses; parts.js contains the scripts of all modules. dist/ also contains the
// types, the licenses and THIRD-PARTY.txt.

import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, "../..");
const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");
const { values } = parseArgs({
  options: {
    modules: { type: "boolean", default: false },
    bindings: { type: "string", default: join(target, "book-work/bindgen") },
    out: { type: "string", default: join(here, "dist") },
  },
});
const [bindings, out] = [resolve(values.bindings), resolve(values.out)];

if (values.modules) {
  const book = ["run", "--locked", "--quiet", "--bin", "epipole-book", "--", "vision"];
  execFileSync("cargo", book, { cwd: root, stdio: "inherit" });
}

const require = createRequire(join(here, "../package.json"));
const { build } = require("esbuild");

// Remove files of earlier builds, which would be shipped otherwise.
rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, "parts"), { recursive: true });
const parts = {};
for (const [, part] of readFileSync(join(here, "src/parts.ts"), "utf8").matchAll(/parts\/(\w+)\.wasm/g)) {
  const name = join(bindings, `epipole_js_${part.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`)}`);
  if (!existsSync(`${name}_bg.wasm`)) {
    console.error(`${name}_bg.wasm is missing: \`make vision\` makes it`);
    process.exit(1);
  }
  copyFileSync(`${name}_bg.wasm`, join(out, "parts", `${part}.wasm`));
  parts[`./parts/${part}.part.js`] = `${name}.js`;
}
const script = { entryNames: "[name]", outdir: out, minify: true, target: "es2022", format: "esm", logLevel: "warning" };
const sources = readdirSync(join(here, "src")).filter((name) => name.endsWith(".ts") && !name.endsWith(".d.ts"));
const entries = (names) => names.map((name) => join(here, "src", name));
await build({ ...script, entryPoints: entries(sources.filter((name) => name !== "parts.ts")) });
// The scripts of the parts are nearly the same: compressed, three in one file are little more than one.
const find = (builder) => builder.onResolve({ filter: /\.part\.js$/ }, ({ path }) => ({ path: parts[path] }));
await build({ ...script, entryPoints: entries(["parts.ts"]), bundle: true, plugins: [{ name: "parts", setup: find }] });
for (const name of readdirSync(out).filter((name) => name.endsWith(".js"))) leaveAlone(join(out, name));

const tsc = require.resolve("typescript/bin/tsc");
const project = ["-p", here, "--emitDeclarationOnly", "--outDir", out];
execFileSync(process.execPath, [tsc, ...project], { stdio: "inherit" });
keepTypes("index");
for (const name of ["LICENSE-APACHE", "LICENSE-MIT"]) copyFileSync(join(root, name), join(out, name));
copyFileSync(join(here, "THIRD-PARTY.txt"), join(out, "THIRD-PARTY.txt"));

/** Marks imports of Node's modules for bundlers to leave alone; minifying has removed the source's marks. */
function leaveAlone(path) {
  const text = readFileSync(path, "utf8");
  writeFileSync(path, text.replace(/\bimport\((?=\w|["'`]node:)/g, "import(/* webpackIgnore: true */ /* @vite-ignore */ "));
}

/** Removes the types that nobody can ask for, and the scripts that contain types only. */
function keepTypes(...names) {
  const kept = new Set(names);
  for (const name of kept) {
    const text = readFileSync(join(out, `${name}.d.ts`), "utf8");
    for (const [, other] of text.matchAll(/from "\.\/(\w+)\.js"/g)) kept.add(other);
  }
  for (const file of readdirSync(out)) {
    const isType = file.endsWith(".d.ts") && !kept.has(file.replace(/\.d\.ts$/, ""));
    if (isType || (file.endsWith(".js") && readFileSync(join(out, file), "utf8").trim() === "")) rmSync(join(out, file));
  }
}
