// Subsets a font: node subset-font.mjs FONT LETTERS.txt OUT.woff2
// Keeps the layout tables (kerning, ligatures, MATH) for the remaining letters.
import { readFile, rename, writeFile } from "node:fs/promises";
import subsetFont from "subset-font";

const [font, letters, out] = process.argv.slice(2);
const text = await readFile(letters, "utf8");
const subset = await subsetFont(await readFile(font), text, { targetFormat: "woff2" });
await writeFile(`${out}.part`, subset);
await rename(`${out}.part`, out);
