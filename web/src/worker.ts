/** Worker for long computations: one request at a time, with one answer each. */

import load, { compute, take_panic } from "epipole-jobs";
import { compile, whyMissing } from "./compile.js";
import { CODE, TRY_AGAIN, type Answer, type Request } from "./jobs.js";

let loading: Promise<unknown> | undefined;

/** Exports that this script requires. */
const WANTED = ["compute", "take_panic"];

/** Minimum interval between progress reports, milliseconds. */
const TELL_MS = 50;

/** Runs a request. Called in the page itself if workers are not allowed. */
export async function carryOut(
  { name, key, request, module, anew }: Request,
  tell: (answer: Answer, transfer?: Transferable[]) => void,
): Promise<void> {
  let told = 0;
  const progress = (share: number) => {
    const now = performance.now();
    if (now - told < TELL_MS) return;
    told = now;
    tell({ key, share });
  };
  try {
    const cache = anew ? "reload" : "default";
    loading ??= compile(
      fetch(module ? new URL(module) : new URL(EPIPOLE_JOBS_WASM, import.meta.url), { cache }),
      WANTED,
    ).then((compiled) => load({ module_or_path: compiled }));
    await loading;
  } catch (problem) {
    // Lets the next request try again.
    loading = undefined;
    tell({ key, problem: `${whyMissing(problem, CODE)}; ${TRY_AGAIN}`, missing: true });
    return;
  }
  tell({ key, share: 0 });
  try {
    const result = compute(name, request, { progress });
    tell({ key, result }, [result.buffer as ArrayBuffer]);
  } catch (problem) {
    const sentence = typeof problem === "string" ? problem : take_panic() ?? String(problem);
    tell({ key, problem: sentence });
  }
}

// Workers have no document.
if (typeof document === "undefined") {
  addEventListener("message", ({ data }: MessageEvent<Request>) => {
    void carryOut(data, (answer, transfer = []) => postMessage(answer, { transfer }));
  });
}
