// A SCORM 1.2 package: its page, its manifest, and its files in a zip file.

import { build } from "esbuild";
import { strToU8, zipSync } from "fflate";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

/** The checkout. */
export const root = join(dirname(fileURLToPath(import.meta.url)), "../..");

export function escape(text) {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;").replaceAll('"', "&quot;");
}

export function read(folder, path) {
  return new Uint8Array(readFileSync(join(folder, path)));
}

function page(title, body) {
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
${body}
</body>
</html>
`;
}

function manifest(name, title, paths) {
  const files = paths.map((path) => `      <file href="${escape(path)}"/>`).join("\n");
  return `<?xml version="1.0" encoding="UTF-8"?>
<manifest identifier="epipole-${escape(name)}" version="1"
  xmlns="http://www.imsproject.org/xsd/imscp_rootv1p1p2" xmlns:adlcp="http://www.adlnet.org/xsd/adlcp_rootv1p2">
  <metadata><schema>ADL SCORM</schema><schemaversion>1.2</schemaversion></metadata>
  <organizations default="organization">
    <organization identifier="organization">
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

/**
 * The bytes of the zip file.
 *
 * `body`, `style`: of the page that the platform opens; `script`: its script in `web/src/`; `files`:
 * contents of the other files by their paths.
 */
export async function pack(name, title, { body, style, script, files }) {
  const { outputFiles } = await build({
    entryPoints: [join(root, "web/src", script)],
    bundle: true,
    write: false,
    format: "esm",
    target: "es2022",
    external: ["./index.js"],
    minify: true,
  });
  const all = {
    "index.html": strToU8(page(title, body)),
    "page.css": strToU8(style),
    "scorm.js": outputFiles[0].contents,
    ...files,
  };
  const list = { "imsmanifest.xml": strToU8(manifest(name, title, Object.keys(all))) };
  // A fixed date, so that the package is reproducible.
  return zipSync({ ...list, ...all }, { level: 9, mtime: new Date(2000, 0, 1) });
}

/** Ends with a message, as a command does whose arguments are wrong. */
export function refuse(message) {
  console.error(message);
  process.exit(2);
}

/** The message for a file that cannot be read: `remedy` makes those that are missing. */
export function explain(problem, remedy) {
  return problem.code === "ENOENT" ? `${problem.path} is missing: ${remedy}` : String(problem);
}
