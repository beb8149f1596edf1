// Packages a chapter as SCORM 1.2, so that learning platforms record its score:
//
//     node web/scorm/chapter.mjs ransac [--out ransac.zip] [--title "RANSAC"] [--site DIR]
//         [--address https://example.org/book/]
//
// DIR holds the built book (default: target/book). The platform keeps what the reader has solved; the
// score is the fraction of the questions and goals reached. Links to other pages lead to the address
// of the published book, and are plain words without one.

import { strToU8 } from "fflate";
import { existsSync, readdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { escape, explain, pack, read, refuse, root } from "./pack.mjs";

const USAGE = "As in: node web/scorm/chapter.mjs ransac --out ransac.zip";
/** Files that any page may load, but for those of the Lab; and licenses. */
const COMMON = /^(assets\/(?!lab[-.]).*\.(js|css|wasm|woff2)|licenses\/.*\.txt)$/;

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { out: { type: "string" }, title: { type: "string" }, site: { type: "string" }, address: { type: "string" } },
});
const [name, more] = positionals;
const { address } = values;
const site = resolve(values.site ?? join(root, "target/book"));
if (!name || more !== undefined || !/^[a-z][a-z0-9-]*$/.test(name)) refuse(`Which chapter? ${USAGE}`);
if (address !== undefined && !/^https?:\/\/[^ ]+\/$/.test(address)) {
  refuse(`"${address}": an address begins with https:// and ends with a slash.`);
}

/** The page with its links, and the paths of the files that it names. */
function chapter(path) {
  const files = new Set();
  const text = new TextDecoder().decode(read(site, path));
  const html = text.replace(/ (href|src|srcset)="([^"#?:]+)([^":]*)"/g, (attribute, kind, named, rest) => {
    if (named.endsWith(".html") && named !== path) return address ? ` href="${escape(address + named)}${rest}"` : "";
    const list = kind === "srcset" ? named.split(",").map((one) => one.trim().split(" ")[0]) : [named];
    for (const file of list) if (file !== path && existsSync(join(site, file))) files.add(file);
    return attribute;
  });
  return { html, files: [...files] };
}

try {
  const path = `${name}.html`;
  const { html, files } = chapter(path);
  const all = readdirSync(site, { recursive: true }).map((file) => file.replaceAll("\\", "/"));
  const paths = new Set([...files, ...all.filter((file) => COMMON.test(file))]);
  const title = values.title ?? /<title>(.*?)( · [^·]*)?<\/title>/.exec(html)?.[1] ?? name;
  const zip = await pack(name, title, {
    body: `<iframe data-src="book/${path}?embed" title="${escape(title)}" allow="fullscreen; clipboard-write"></iframe>`,
    style: "html, body { height: 100%; margin: 0; overflow: hidden }\niframe { width: 100%; height: 100%; border: 0 }\n",
    script: "scorm_chapter.ts",
    files: {
      [`book/${path}`]: strToU8(html),
      ...Object.fromEntries([...paths].sort().map((file) => [`book/${file}`, read(site, file)])),
    },
  });
  writeFileSync(values.out ?? `${name}.zip`, zip);
} catch (problem) {
  console.error(explain(problem, "is it a chapter, and did `make build` run?"));
  process.exit(1);
}
