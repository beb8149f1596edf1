// Cuts a font down to some letters: node subset-font.mjs FONT LETTERS.txt OUT.woff2
// Layout tables (kerning, ligatures, the MATH table) are kept for the letters that stay.
import { readFile, rename, writeFile } from "node:fs/promises";
import subsetFont from "subset-font";

const [font, letters, out] = process.argv.slice(2);
const text = await readFile(letters, "utf8");
const subset = await subsetFont(await readFile(font), text, { targetFormat: "woff2" });
await writeFile(`${out}.part`, subset);
await rename(`${out}.part`, out);
