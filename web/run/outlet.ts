/**
 * Sends output to the page in pieces, so that an endless loop neither floods the page nor hides what it printed.
 */

import type { FromWorker, Item } from "./messages.js";

/** Most items of a run. */
export const MOST_ITEMS = 1000;
/** Time between two pieces of output, milliseconds. */
const PIECE_MS = 50;

export const post = (message: FromWorker) => self.postMessage(message);
let items: Item[] = [];
let count = 0;
let sent = 0;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Sends what is collected. */
export function flush(): void {
  clearTimeout(timer);
  timer = undefined;
  sent = performance.now();
  if (items.length > 0) post({ type: "items", items });
  items = [];
}

/** Adds to the output; nothing once a run has put out too much. */
export function put(item: Item): void {
  count += 1;
  if (count > MOST_ITEMS) return;
  items.push(item);
  if (count === MOST_ITEMS) {
    items.push({ type: "text", text: `(more than ${MOST_ITEMS} lines: the rest is left out)`, isProblem: true });
    flush();
  } else if (performance.now() - sent > PIECE_MS) flush();
  else timer ??= setTimeout(flush, PIECE_MS);
}
