// Runs the JavaScript of the chapters on the npm package of the core, as built by `make vision`.
//
//     node tests/listings/run.mjs [--bless] [CHAPTER.md ...]
//
// Each listing is a program of its own. Its output is compared with
// content/listings/<chapter>.<name>.js.txt; --bless writes these files instead. The check of a task
// must refuse its start and accept its solution; tasks with a figure are left to the browser.

import { execFile } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";

const ROOT = fileURLToPath(new URL("../..", import.meta.url));
const CONTENT = join(ROOT, "content");
const OPENING = /^\s*\{\{#(listing|task) ([a-z0-9-]+)/;
const ENDING = /^\s*\{\{\/(listing|task)\}\}/;
/** An assertion that fails ends the program. */
const START = "console.assert = (holds, ...words) => { if (!holds) throw new Error(`assertion failed ${words}`); };";
const TIME_LIMIT_MS = 60_000;

/** Fences of JavaScript in a chapter: kind and name of their block, word, code and line. */
function blocks(path) {
  const found = [];
  let [kind, name, fence] = ["plain", "", undefined];
  readFileSync(path, "utf8").split("\n").forEach((line, index) => {
    if (fence) {
      if (line.trim() !== "```") fence.code += `${line}\n`;
      else {
        found.push(fence);
        fence = undefined;
      }
      return;
    }
    const opening = OPENING.exec(line);
    const start = /^```js(?: (\w+))?$/.exec(line.trim());
    if (opening) [, kind, name] = opening;
    else if (ENDING.test(line)) [kind, name] = ["plain", ""];
    else if (start) fence = { kind, name, word: start[1] ?? "", code: "", line: index + 1 };
  });
  return found;
}

/** Output of a module, run in a folder where the package is installed. */
async function run(folder, code) {
  const file = join(folder, "program.mjs");
  // On the first line, so that errors name the lines of the fence.
  writeFileSync(file, `${START} ${code}`);
  const { stdout } = await promisify(execFile)(process.execPath, [file], { cwd: folder, timeout: TIME_LIMIT_MS });
  return stdout;
}

/** The problems of a block: none if it is right. */
async function problemOf(block, parts, chapter, folder, bless) {
  const { kind, name, word, code } = block;
  if (kind === "task") {
    if (word !== "solution") return undefined;
    const judged = (body) =>
      run(folder, `${body}\n;console.log("verdict", await (async () => {${parts.check.code}\n})());`);
    const refused = /^verdict Not yet/m.test(await judged(parts.start.code));
    const said = await judged(code);
    if (!refused) return "its check accepts the start";
    return /^verdict Right/m.test(said) ? undefined : `its check says of the solution: ${said}`;
  }
  const printed = await run(folder, code);
  if (kind === "plain") return undefined;
  const file = join(CONTENT, "listings", `${chapter}.${name}.js.txt`);
  if (bless) writeFileSync(file, printed);
  const recorded = existsSync(file) ? readFileSync(file, "utf8") : "nothing\n";
  return printed === recorded ? undefined : `it prints\n${printed}recorded is\n${recorded}`;
}

const given = process.argv.slice(2);
const bless = given.includes("--bless");
const named = given.filter((word) => word !== "--bless");
const all = readdirSync(CONTENT).filter((name) => name.endsWith(".md")).map((name) => join(CONTENT, name));
const folder = mkdtempSync(join(tmpdir(), "listings-"));
let [passed, failed, skipped] = [0, 0, 0];
try {
  mkdirSync(join(folder, "node_modules/@epipole"), { recursive: true });
  symlinkSync(join(ROOT, "web/vision"), join(folder, "node_modules/@epipole/vision"), "dir");
  for (const path of named.length > 0 ? named : all.sort()) {
    const chapter = basename(path, ".md");
    const parts = {};
    for (const block of blocks(path)) {
      if (block.kind === "task") parts[block.word] = block;
      if (block.word === "solution" && /\bfigure\(/.test(block.code)) {
        skipped += 1;
        continue;
      }
      const problem = await problemOf(block, parts, chapter, folder, bless).catch((error) => error.stderr || error.message);
      if (block.kind === "task" && block.word !== "solution" && problem === undefined) continue;
      if (problem === undefined) passed += 1;
      else {
        failed += 1;
        console.error(`${path}:${block.line}: ${block.name}: ${problem}`);
      }
    }
  }
} finally {
  rmSync(folder, { recursive: true });
}
console.log(`ℹ pass ${passed}\nℹ fail ${failed}\nℹ skipped ${skipped}, which need figures: the browser runs them`);
process.exitCode = failed > 0 ? 1 : 0;
