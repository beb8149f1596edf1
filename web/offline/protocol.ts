// Messages between a page of the book and its service worker.

import type { Variant } from "./pictures";

/** Page to worker: keep this page with what it needs; with `all`, the rest of the book, too. */
export interface Keep {
  page: string | undefined;
  all: boolean;
  /** The pictures to keep. */
  variant: Variant;
}

/** Page to waiting worker: replace the running one. */
export const TAKE_OVER = "take over";

/** Worker to page: the whole book is kept. */
export const COMPLETE = "complete";
