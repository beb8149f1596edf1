// Messages between a page of the book and its service worker.

import type { Variant } from "./pictures";

/** Page to worker: cache this page with its files; with `all`, the whole book. */
export interface CacheRequest {
  page: string | undefined;
  all: boolean;
  /** Width and theme of the pictures. */
  variant: Variant;
}

/** Page to waiting worker: replace the running one. */
export const TAKE_OVER = "take over";

/** Worker to page: the whole book is cached. */
export const COMPLETE = "complete";
