// Packages a figure as SCORM 1.2, so that learning platforms record its score:
//
//     node web/scorm.mjs ransac-race outliers=0.6 [--out race.zip] [--title "Who is right?"]
//         [--package DIR]
//
// DIR holds the files of the npm package (default: web/dist). The platform restores the reader's
// state; the score is the fraction of the figure's goals reached.

import { build } from "esbuild";
import { strToU8, zipSync } from "fflate";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { argv } from "node:process";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const here = dirname(fileURLToPath(import.meta.url));
/** Files that a figure loads, and the third-party notices. */
const FILES = ["index.js", "worker.js", "epipole-figures.wasm", "epipole-jobs.wasm", "THIRD-PARTY.txt"];

function escape(text) {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
}

function page(name, title, parameters) {
  const attributes = parameters.map(([key, value]) => ` ${key}="${escape(value)}"`).join("");
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escape(title)}</title>
<link rel="stylesheet" href="page.css">
<script type="module" src="scorm.js"></script>
</head>
<body>
<epipole-figure name="${escape(name)}"${attributes}></epipole-figure>
</body>
</html>
`;
}

function manifest(name, title) {
  const files = ["index.html", "page.css", "scorm.js", ...FILES].map((file) => `      <file href="${file}"/>`).join("\n");
  return `<?xml version="1.0" encoding="UTF-8"?>
<manifest identifier="epipole-${escape(name)}" version="1"
  xmlns="http://www.imsproject.org/xsd/imscp_rootv1p1p2" xmlns:adlcp="http://www.adlnet.org/xsd/adlcp_rootv1p2">
  <metadata><schema>ADL SCORM</schema><schemaversion>1.2</schemaversion></metadata>
  <organizations default="figure">
    <organization identifier="figure">
      <title>${escape(title)}</title>
      <item identifier="item" identifierref="page"><title>${escape(title)}</title></item>
    </organization>
  </organizations>
  <resources>
    <resource identifier="page" type="webcontent" adlcp:scormtype="sco" href="index.html">
${files}
    </resource>
  </resources>
</manifest>
`;
}

/** The package as the bytes of a zip file. `parameters` are pairs of name and value. */
export async function scorm(name, parameters, { title = name, from = join(here, "dist") } = {}) {
  const { outputFiles } = await build({
    entryPoints: [join(here, "src/scorm.ts")],
    bundle: true,
    write: false,
    format: "esm",
    target: "es2022",
    external: ["./index.js"],
    minify: true,
  });
  const files = {
    "imsmanifest.xml": strToU8(manifest(name, title)),
    "index.html": strToU8(page(name, title, parameters)),
    "page.css": strToU8("body { margin: 0 }\nepipole-figure { display: block; --epipole-max-width: none }\n"),
    "scorm.js": outputFiles[0].contents,
    ...Object.fromEntries(FILES.map((file) => [file, new Uint8Array(readFileSync(join(from, file)))])),
  };
  // A fixed date, so that the package is reproducible.
  return zipSync(files, { level: 9, mtime: new Date(2000, 0, 1) });
}

if (argv[1] && resolve(argv[1]) === fileURLToPath(import.meta.url)) {
  const { values, positionals } = parseArgs({
    allowPositionals: true,
    options: { out: { type: "string" }, title: { type: "string" }, package: { type: "string" } },
  });
  const [name, ...settings] = positionals;
  const odd = settings.find((setting) => !/^[a-z][\w-]*=/.test(setting));
  if (!name || !/^[a-z][a-z0-9-]*$/.test(name) || odd !== undefined) {
    const why = odd === undefined ? "which figure?" : `"${odd}": a parameter is written name=value`;
    console.error(`${why} As in: node web/scorm.mjs ransac-race outliers=0.6 --out race.zip`);
    process.exit(2);
  }
  const parameters = settings.map((setting) => [setting.slice(0, setting.indexOf("=")), setting.slice(setting.indexOf("=") + 1)]);
  const more = { ...(values.title ? { title: values.title } : {}), ...(values.package ? { from: resolve(values.package) } : {}) };
  try {
    writeFileSync(values.out ?? `${name}.zip`, await scorm(name, parameters, more));
  } catch (problem) {
    console.error(problem.code === "ENOENT" ? `${problem.path} is missing: \`npm run build\` in web/ makes it` : String(problem));
    process.exit(1);
  }
}
