/** Sends output to the page in batches, so that an endless loop neither floods the page nor hides its output. */

import type { FromWorker, Item } from "./messages.js";

/** Maximum number of items per run. */
export const MOST_ITEMS = 1000;
/** Interval between batches of output, milliseconds. */
const PIECE_MS = 50;

export const post = (message: FromWorker) => self.postMessage(message);
let items: Item[] = [];
let count = 0;
let sent = 0;
let timer: ReturnType<typeof setTimeout> | undefined;

/** Sends the collected output. */
export function flush(): void {
  clearTimeout(timer);
  timer = undefined;
  sent = performance.now();
  if (items.length > 0) post({ type: "items", items });
  items = [];
}

/** Adds an item to the output; nothing once a run exceeds the maximum. */
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
