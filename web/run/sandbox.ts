/**
 * Worker environment for a reader's code: console, functions of the page, errors. The code's module imports it first.
 */

import { figure } from "./figure.js";
import { inspect } from "./inspect.js";
import type { Fault } from "./messages.js";
import { flush, MOST_ITEMS, post, put } from "./outlet.js";
import { plot, show } from "./show.js";

export { begin } from "./figure.js";

/** Maximum length of a printed text, characters. */
const MOST_CHARACTERS = 4000;

const printer = (isProblem: boolean) => (...values: unknown[]) => {
  const text = values.map(inspect).join(" ");
  const isLong = text.length > MOST_CHARACTERS;
  put({ type: "text", text: isLong ? `${text.slice(0, MOST_CHARACTERS)} …` : text, isProblem });
};

function table(rows: unknown): void {
  if (typeof rows !== "object" || rows === null) return printer(false)(rows);
  const records = Array.from(Object.entries(rows)).slice(0, MOST_ITEMS);
  const cells = (row: unknown): Record<string, unknown> =>
    typeof row === "object" && row !== null ? { ...row } : { value: row };
  const columns = [...new Set(records.flatMap(([, row]) => Object.keys(cells(row))))];
  const shown = records.map(([name, row]) => {
    const own = cells(row);
    return [name, ...columns.map((column) => (column in own ? inspect(own[column]) : ""))];
  });
  put({ type: "table", columns: ["(index)", ...columns], rows: shown });
}

/** Called after the last line of the code. */
export function finish(...verdict: unknown[]): void {
  flush();
  if (verdict.length > 0) post({ type: "verdict", text: String(verdict[0]) });
  post({ type: "done" });
}

/** Returns an error with its position in the code: the first stack frame in its module. */
function faultOf(problem: unknown): Fault {
  const { name = "Error", message, stack = "" } = problem instanceof Error ? problem : { message: inspect(problem) };
  const at = stack.split(location.href)[1]?.match(/^:(\d+):(\d+)/);
  return { name, message, line: at ? Number(at[1]) : undefined, column: at ? Number(at[2]) : undefined };
}

function fail(problem: unknown): void {
  flush();
  post({ type: "fault", fault: faultOf(problem) });
}

self.addEventListener("error", (event) => {
  event.preventDefault();
  const { error, message, lineno: line, colno: column } = event;
  if (error instanceof Error) fail(error);
  else {
    flush();
    post({ type: "fault", fault: { name: "Error", message, line, column } });
  }
});
self.addEventListener("unhandledrejection", (event) => {
  event.preventDefault();
  fail(event.reason);
});

const print = printer(false);
Object.assign(console, { log: print, info: print, debug: print, table, warn: printer(true), error: printer(true) });
console.assert = (holds?: unknown, ...words: unknown[]) => {
  if (!holds) printer(true)("Assertion failed", ...words);
};
Object.assign(self, { show, plot, figure });
// A reader's code must not access data that the book and the Lab store in this browser.
for (const name of ["indexedDB", "caches", "BroadcastChannel", "Worker", "importScripts"]) {
  Object.defineProperty(self, name, { value: undefined });
}
Object.defineProperty(navigator, "storage", { value: undefined });
Object.defineProperty(navigator, "locks", { value: undefined });
