/** Runs calls in this thread. */

import { errorOf, faultOf } from "./errors.js";
import { callPart, loadPart, type Report } from "./host.js";
import { closed, type Job, type Runner } from "./runner.js";

export class ThreadRunner implements Runner {
  #isClosed = false;

  async run({ part, name, given, signal, progress }: Job): Promise<unknown> {
    if (this.#isClosed) throw closed();
    signal?.throwIfAborted();
    const loaded = await loadPart(part);
    if (this.#isClosed) throw closed();
    signal?.throwIfAborted();
    if (name === undefined) return undefined;
    const thrown: unknown[] = [];
    const report: Report = (stage, fraction) => {
      try {
        progress?.(stage, fraction);
      } catch (problem) {
        thrown.push(problem);
      }
      return thrown.length === 0 && !signal?.aborted;
    };
    try {
      return callPart(loaded, name, given, progress || signal ? report : undefined);
    } catch (problem) {
      if (thrown.length > 0) throw thrown[0];
      signal?.throwIfAborted();
      throw Array.isArray(problem) ? errorOf(faultOf(problem)) : problem;
    }
  }

  close(): void {
    this.#isClosed = true;
  }

  closeLater(): void {
    // No resources are held outside of the caller's memory.
  }
}
