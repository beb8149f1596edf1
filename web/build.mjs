// Bundles the elements: node web/build.mjs --bindings DIR --out DIR [--plain]
//
// DIR of --bindings holds epipole_web.js and epipole_web_bg.wasm, as wasm-bindgen makes them for the
// web. Out come the script and the WebAssembly module side by side, with names made of their content
// (--plain: epipole.js, for a place where the name is a promise). Prints what it made as JSON:
// {"script": …, "module": …, "files": […]}.

import { build } from "esbuild";
import { existsSync } from "node:fs";
import { basename, dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const here = dirname(fileURLToPath(import.meta.url));
const { values } = parseArgs({
  options: {
    bindings: { type: "string", default: join(here, "pkg") },
    out: { type: "string", default: join(here, "dist") },
    plain: { type: "boolean", default: false },
  },
});

const bindings = resolve(values.bindings);
const paths = { glue: join(bindings, "epipole_web.js"), wasm: join(bindings, "epipole_web_bg.wasm") };
for (const path of Object.values(paths)) {
  if (!existsSync(path)) {
    console.error(`${path} is missing: make the bindings of epipole-web first`);
    process.exit(1);
  }
}

const result = await build({
  entryPoints: [join(here, "src/epipole.ts")],
  outdir: resolve(values.out),
  entryNames: values.plain ? "[name]" : "[name]-[hash]",
  assetNames: "[name]-[hash]",
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  alias: { "#bindings": paths.glue, "#wasm": paths.wasm },
  loader: { ".css": "text", ".wasm": "file" },
  plugins: [minifyStyles()],
  metafile: true,
  logLevel: "warning",
});

const files = Object.keys(result.metafile.outputs).map((path) => basename(path));
console.log(
  JSON.stringify({
    script: files.find((name) => name.endsWith(".js")),
    module: files.find((name) => name.endsWith(".wasm")),
    files,
  }),
);

/** Style sheets become strings of the script; they are minified on the way. */
function minifyStyles() {
  return {
    name: "minify-styles",
    setup({ onLoad }) {
      onLoad({ filter: /\.css$/ }, async ({ path }) => {
        const made = await build({ entryPoints: [path], minify: true, write: false, target: "es2022" });
        return { contents: made.outputFiles[0].text, loader: "text" };
      });
    },
  };
}
