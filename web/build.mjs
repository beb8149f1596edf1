// Makes the npm package: node web/build.mjs [--bindings DIR] [--out DIR]
//
// DIR of --bindings holds epipole_web.js and epipole_web_bg.wasm, as wasm-bindgen makes them for the
// web. Out come index.js, worker.js, the module beside them, and the types. (The book bundles the same sources
// itself, with names made of their content.)

import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({
  options: {
    bindings: { type: "string", default: join(here, "../target/book-work/bindgen") },
    out: { type: "string", default: join(here, "dist") },
  },
});

const [bindings, out] = [resolve(values.bindings), resolve(values.out)];
const [glue, wasm] = [join(bindings, "epipole_web.js"), join(bindings, "epipole_web_bg.wasm")];
for (const path of [glue, wasm]) {
  if (!existsSync(path)) {
    console.error(`${path} is missing: \`make build\` makes it`);
    process.exit(1);
  }
}

mkdirSync(out, { recursive: true });
copyFileSync(wasm, join(out, "epipole.wasm"));
await build({
  entryPoints: [join(here, "src/index.ts"), join(here, "src/worker.ts")],
  outdir: out,
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  alias: { "epipole-web": glue },
  define: { EPIPOLE_WASM: '"epipole.wasm"', EPIPOLE_WORKER: '"worker.js"' },
  logLevel: "warning",
});
execFileSync("npx", ["tsc", "--emitDeclarationOnly", "--outDir", join(out, "types")], {
  cwd: here,
  stdio: "inherit",
});
