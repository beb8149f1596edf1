// Locations of the tested files: the site that `make build` writes to target/book.
//
// EPIPOLE_ELEMENTS and EPIPOLE_BINDINGS select other folders, such as the npm package.

import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const here = dirname(fileURLToPath(import.meta.url));
export const root = resolve(here, "../..");
const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");

/** Folder of the site; undefined when testing other elements. */
export const book = process.env.EPIPOLE_ELEMENTS ? undefined : join(target, "book");

/** Folder with the script of the elements and everything that it loads. */
export const elements = process.env.EPIPOLE_ELEMENTS ?? join(target, "book");
export const script = book ? "embed/epipole.js" : "index.js";

/** The generated bindings, epipole_figures.js and epipole_jobs.js. */
export const bindings = process.env.EPIPOLE_BINDINGS ?? join(target, "book-work/bindgen");

const glue = (name) => join(bindings, `epipole_${name}.js`);
for (const path of [join(elements, script), glue("figures"), glue("jobs")]) {
  if (!existsSync(path)) throw new Error(`${path} is missing: run \`make build\` first`);
}

/** WebAssembly modules that readers download, relative to `elements`: page, then workers. */
export const wasm = find(elements, book ? "assets" : "", /^epipole-figures.*\.wasm$/);
export const jobsWasm = find(elements, book ? "assets" : "", /^epipole-jobs.*\.wasm$/);

/** Script that defines the elements, relative to `elements`. */
export const code = book ? find(elements, "assets", /^index-.*\.js$/) : script;

function find(folder, under, pattern) {
  const name = readdirSync(join(folder, under)).find((file) => pattern.test(file));
  if (!name) throw new Error(`${join(folder, under)} holds no ${pattern}`);
  return under ? `${under}/${name}` : name;
}

/** The bindings of both modules, loaded into this process. */
export async function loadBindings() {
  const [page, worker] = await Promise.all([load("figures", wasm), load("jobs", jobsWasm)]);
  return { ...page, compute: worker.compute };
}

async function load(name, wasm) {
  // As a data URL, since Node would load a .js file as CommonJS.
  const text = readFileSync(glue(name));
  const module = await import(`data:text/javascript;base64,${text.toString("base64")}`);
  await module.default({ module_or_path: readFileSync(join(elements, wasm)) });
  return module;
}
