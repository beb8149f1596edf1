/** A reader's code as a module: finds its imports and its syntax errors. */

import { parser } from "@lezer/javascript";
import type { Fault, FigureFacts } from "./messages.js";

/** The package that code may import. */
const PACKAGE = "@epipole/vision";

/** Addresses of the scripts that the module imports. */
export interface Addresses {
  sandbox: string;
  vision: string;
}

/** Text of the module, and the offset of its first line. */
export interface Prepared {
  text: string;
  shift: number;
}

/** Converts an offset to line and column, counted from 1. */
export function placeOf(code: string, offset: number): { line: number; column: number } {
  const before = code.slice(0, offset).split("\n");
  return { line: before.length, column: (before.at(-1) ?? "").length + 1 };
}

/**
 * Creates a module that loads the sandbox first, passes it the figures of the page, and notifies it at the end. `check`
 * is the body of a function that returns a verdict; it can access the code's names.
 */
export function prepare(
  code: string,
  { sandbox, vision }: Addresses,
  figures: Record<string, FigureFacts>,
  check?: string,
): Prepared | Fault {
  const tree = parser.parse(code);
  const specifiers: { from: number; to: number }[] = [];
  let fault: Fault | undefined;
  const refuse = (offset: number, message: string) => {
    fault ??= { name: "ImportError", message, ...placeOf(code, offset) };
  };
  tree.iterate({
    enter({ name, from, to, node }) {
      if (name === "DynamicImport" || (name === "import" && node.parent?.name === "CallExpression")) {
        refuse(from, `import(…) is not available here; write import { Vision } from "${PACKAGE}" at the top`);
      }
      const isSource = name === "String" && /^(Import|Export)Declaration$/.test(node.parent?.name ?? "");
      if (!isSource) return;
      const wanted = code.slice(from + 1, to - 1);
      if (wanted === PACKAGE) specifiers.push({ from, to });
      else refuse(from, `"${wanted}" cannot be imported here: only ${PACKAGE} is there`);
    },
  });
  if (fault) return fault;
  let text = code;
  for (const { from, to } of specifiers.reverse()) {
    text = `${text.slice(0, from)}${JSON.stringify(vision)}${text.slice(to)}`;
  }
  const names = "begin as epipole_begin, finish as epipole_finish";
  const start = `import {${names}} from ${JSON.stringify(sandbox)};epipole_begin(${JSON.stringify(figures)});`;
  const end = check === undefined ? "epipole_finish();" : `epipole_finish(await (async () => {${check}\n})());`;
  return { text: `${start}${text}\n;${end}`, shift: start.length };
}

/** Returns the first syntax error, for browsers that do not report its position. */
export function firstMistake(code: string): Fault {
  let from = -1;
  parser.parse(code).iterate({
    enter(node) {
      if (node.type.isError && from < 0) from = node.from;
    },
  });
  const name = "SyntaxError";
  if (from < 0) {
    const reasons = "a name is declared twice, or await stands in a function that is not async";
    return { name, message: `the browser does not read this code: perhaps ${reasons}` };
  }
  const token = /^(\w+|.)/.exec(code.slice(from).trimStart())?.[0];
  const message = token === undefined ? "the code ends too early: a bracket or a quote is open" : `unexpected ${token}`;
  return { name, message, ...placeOf(code, from) };
}
