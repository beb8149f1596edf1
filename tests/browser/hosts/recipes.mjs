// Recipes as folders: the files shown on a page of docs/embed/, as a reader would write them.

import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { root } from "../places.mjs";

const target = process.env.CARGO_TARGET_DIR ?? join(root, "target");
/** Folder in which the hosts are built. */
export const work = join(target, "hosts");

/** Files of a recipe, by name: each is a line "`name`:" followed by a fence. */
export function filesOf(recipe) {
  const text = readFileSync(join(root, "docs/embed", `${recipe}.md`), "utf8");
  // A fence around fences has more backticks.
  const files = [...text.matchAll(/^`([\w./-]+)`[^\n]*:\n\n((?:(`{3,})\w*\n[\s\S]*?^\3\n+)+)/gm)].map(([, name, fences]) => {
    const parts = [...fences.matchAll(/^(`{3,})\w*\n([\s\S]*?)^\1$/gm)].map(([, , part]) => part);
    return [name, parts];
  });
  if (files.length === 0) throw new Error(`docs/embed/${recipe}.md shows no file`);
  return files;
}

/** Writes the files of a recipe to a new folder; `book` is the book's address. */
export function folderOf(recipe, book) {
  const folder = join(work, "made", recipe);
  rmSync(folder, { recursive: true, force: true });
  for (const [name, parts] of filesOf(recipe)) {
    const path = join(folder, name);
    mkdirSync(dirname(path), { recursive: true });
    const text = name.endsWith(".ipynb") ? notebook(parts) : parts.join("");
    writeFileSync(path, text.replaceAll("https://book.example/", `${book}/`));
  }
  return folder;
}

function notebook(cells) {
  return JSON.stringify({
    nbformat: 4,
    nbformat_minor: 5,
    metadata: { kernelspec: { name: "python3", display_name: "Python 3", language: "python" } },
    cells: cells.map((source, index) => ({ cell_type: "code", id: `cell-${index}`, metadata: {}, execution_count: null, outputs: [], source })),
  });
}
