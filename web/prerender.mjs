// Writes the trees of figures as text: node web/prerender.mjs < wanted.json > trees.json
//
// In goes a JSON array of {name, title, help, snapshot, attributes, sizes}, the snapshot as the module
// gives it (a figure's own JSON, for any width), sizes the pairs [width, height] of its picture at the
// widths 360, 720 and 1088; out comes a JSON array of strings, each the inside
// of a <template shadowrootmode="open">. In them {{figure.css}} stands for the address of the style
// sheet, which is web/src/figure.css. The very code that runs in browsers makes them.

import { build } from "esbuild";
import { parseHTML } from "linkedom";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { argv } from "node:process";
import { text } from "node:stream/consumers";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

/** Makes the function that turns what is wanted into text. */
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
