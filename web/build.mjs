// Builds the npm package: node web/build.mjs [--bindings DIR] [--out DIR]
//
// --bindings is the folder with the scripts and modules epipole_figures and epipole_jobs that
// wasm-bindgen generates for the web. The package contains index.js, worker.js, the modules,
// auto.js for pages without module scripts, react.js, custom-elements.json, the types and
// THIRD-PARTY.txt. (The book bundles the same sources itself, with content hashes in the file
// names.)

import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { look } from "./look.mjs";
import { manifest } from "./manifest.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({
  options: {
    bindings: { type: "string", default: join(here, "../target/book-work/bindgen") },
    out: { type: "string", default: join(here, "dist") },
  },
});

const [bindings, out] = [resolve(values.bindings), resolve(values.out)];
const parts = ["figures", "jobs"].map((name) => ({
  name,
  glue: join(bindings, `epipole_${name}.js`),
  wasm: join(bindings, `epipole_${name}_bg.wasm`),
}));
for (const path of parts.flatMap(({ glue, wasm }) => [glue, wasm])) {
  if (!existsSync(path)) {
    console.error(`${path} is missing: \`make build\` makes it`);
    process.exit(1);
  }
}

// Remove files of earlier builds, which would be shipped otherwise.
rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
for (const { name, wasm } of parts) copyFileSync(wasm, join(out, `epipole-${name}.wasm`));
await build({
  entryPoints: [join(here, "src/index.ts"), join(here, "src/worker.ts")],
  outdir: out,
  bundle: true,
  target: "es2022",
  minify: true,
  alias: { "epipole-web": parts[0].glue, "epipole-jobs": parts[1].glue },
  define: {
    EPIPOLE_WASM: '"./epipole-figures.wasm"',
    EPIPOLE_JOBS_WASM: '"./epipole-jobs.wasm"',
    EPIPOLE_WORKER: '"./worker.js"',
  },
  plugins: [look],
  format: "esm",
  logLevel: "warning",
});
for (const name of ["index.js", "worker.js"]) leaveAlone(join(out, name));
// From another origin, a classic script resolves import() against the page: give the full address.
writeFileSync(join(out, "auto.js"), 'import(new URL("index.js", document.currentScript.src));\n');
writeFileSync(join(out, "react.js"), 'export { EpipoleFigure } from "./index.js";\n');
writeFileSync(join(out, "custom-elements.json"), `${JSON.stringify(manifest(), null, 2)}\n`);
execFileSync("npx", ["tsc", "--emitDeclarationOnly", "--outDir", join(out, "types")], {
  cwd: here,
  stdio: "inherit",
});
copyFileSync(join(here, "THIRD-PARTY-FIGURES.txt"), join(out, "THIRD-PARTY.txt"));
copyFileSync(join(here, "react.d.ts"), join(out, "types/react.d.ts"));
for (const name of ["auto", "script"]) writeFileSync(join(out, `types/${name}.d.ts`), "export {};\n");
keepTypes(join(out, "types"), ["index", "react", "auto", "script"]);

/** Marks dynamic imports for bundlers to leave alone; minifying has removed the source's marks. */
function leaveAlone(path) {
  const text = readFileSync(path, "utf8");
  const open = /\bimport\((?!["'`])/g;
  const count = [...text.matchAll(open)].length;
  if (count > 1) throw new Error(`${path} imports ${count} addresses that are only known when it runs`);
  writeFileSync(path, text.replace(open, "import(/* webpackIgnore: true */ /* @vite-ignore */ "));
}

/** Removes the types that nobody can ask for: those that the given ones do not name. */
function keepTypes(folder, names) {
  const kept = new Set(names);
  for (const name of kept) {
    const text = readFileSync(join(folder, `${name}.d.ts`), "utf8");
    for (const [, other] of text.matchAll(/(?:from|import) ?\(?"\.\/([\w-]+)\.js"/g)) kept.add(other);
  }
  for (const file of readdirSync(folder)) if (!kept.has(file.replace(/\.d\.ts$/, ""))) rmSync(join(folder, file));
}
