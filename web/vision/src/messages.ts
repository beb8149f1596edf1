/** Messages to and from a worker. */

import type { Part } from "./api.js";
import type { Fault } from "./errors.js";

/** A call; without a name, it only loads the part. */
export interface Call {
  id: number;
  part: Part;
  name: string | undefined;
  given: readonly unknown[];
  /** Whether the caller wants reports of progress. */
  reports: boolean;
}

/** Progress, a result or an error. */
export type Answer =
  | { id: number; stage: string; fraction: number }
  | { id: number; result: unknown }
  | { id: number; fault: Fault };
