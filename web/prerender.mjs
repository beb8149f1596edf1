// Prerenders the shadow trees of figures: node web/prerender.mjs < wanted.json > trees.json
//
// Input: a JSON array of {name, title, help, snapshot, attributes, sizes}. `snapshot` is the
// figure's JSON as the module returns it (for any width); `sizes` are the pairs [width, height] of
// its picture at the widths 360, 720 and 1088. Output: a JSON array of strings, each the content of
// a <template shadowrootmode="open">, in which {{figure.css}} is the placeholder for the address of
// the style sheet (web/src/figure.css). Browsers run the same code.

import { build } from "esbuild";
import { parseHTML } from "linkedom";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { argv } from "node:process";
import { text } from "node:stream/consumers";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

/** Returns the prerender function, bundled from the TypeScript sources. */
export async function prerenderer() {
  const { document } = parseHTML("<!DOCTYPE html><html><body></body></html>");
  globalThis.document ??= document;
  const folder = mkdtempSync(join(tmpdir(), "epipole-"));
  try {
    const outfile = join(folder, "prerender.mjs");
    await build({
      entryPoints: [join(here, "src/prerender.ts")],
      outfile,
      bundle: true,
      format: "esm",
      platform: "node",
      logLevel: "warning",
    });
    return (await import(pathToFileURL(outfile).href)).prerender;
  } finally {
    rmSync(folder, { recursive: true });
  }
}

if (argv[1] && resolve(argv[1]) === fileURLToPath(import.meta.url)) {
  const prerender = await prerenderer();
  const wanted = JSON.parse(await text(process.stdin));
  process.stdout.write(JSON.stringify(wanted.map(prerender)));
}
