// Packages a figure as SCORM 1.2, so that learning platforms record its score:
//
//     node web/scorm/figure.mjs ransac-race outliers=0.6 [--out race.zip] [--title "Who is right?"]
//         [--package DIR]
//
// DIR holds the files of the npm package (default: web/dist). The platform restores the reader's
// state; the score is the fraction of the figure's goals reached.

import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { escape, explain, pack, read, refuse, root } from "./pack.mjs";

/** Files that a figure loads, and the third-party notices. */
const FILES = ["index.js", "worker.js", "epipole-figures.wasm", "epipole-jobs.wasm", "THIRD-PARTY.txt"];
const USAGE = "As in: node web/scorm/figure.mjs ransac-race outliers=0.6 --out race.zip";

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { out: { type: "string" }, title: { type: "string" }, package: { type: "string" } },
});
const [name, ...settings] = positionals;
const odd = settings.find((setting) => !/^[a-z][\w-]*=/.test(setting));
if (odd !== undefined) refuse(`"${odd}": a parameter is written name=value. ${USAGE}`);
if (!name || !/^[a-z][a-z0-9-]*$/.test(name)) refuse(`Which figure? ${USAGE}`);
const attributes = settings.map((setting) => {
  const end = setting.indexOf("=");
  return ` ${setting.slice(0, end)}="${escape(setting.slice(end + 1))}"`;
});
const folder = resolve(values.package ?? join(root, "web/dist"));
try {
  const zip = await pack(name, values.title ?? name, {
    body: `<epipole-figure name="${escape(name)}"${attributes.join("")}></epipole-figure>`,
    style: "body { margin: 0 }\nepipole-figure { display: block; --epipole-max-width: none }\n",
    script: "scorm.ts",
    files: Object.fromEntries(FILES.map((file) => [file, read(folder, file)])),
  });
  writeFileSync(values.out ?? `${name}.zip`, zip);
} catch (problem) {
  console.error(explain(problem, "`npm run build` in web/ makes it"));
  process.exit(1);
}
