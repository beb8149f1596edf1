// Where the tests find what they test.

import { existsSync, readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

export const here = dirname(fileURLToPath(import.meta.url));
export const root = resolve(here, "../..");

/** The generated bindings: epipole_web.js and epipole_web_bg.wasm. */
export const bindings = process.env.EPIPOLE_BINDINGS ?? join(root, "web/pkg");
/** The bundled elements: epipole.js and the module beside it. */
export const elements = process.env.EPIPOLE_ELEMENTS ?? join(root, "web/dist");

/** The bindings, loaded into this process. */
export async function loadBindings() {
  const glue = join(bindings, "epipole_web.js");
  if (!existsSync(glue)) throw new Error(`${glue} is missing: build the elements first`);
  const module = await import(pathToFileURL(glue).href);
  await module.default({ module_or_path: readFileSync(join(bindings, "epipole_web_bg.wasm")) });
  return module;
}
