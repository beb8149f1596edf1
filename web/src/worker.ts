/** Long computations, away from the page: one request at a time, one answer each. */

import load, { compute, take_panic } from "epipole-jobs";
import { compile, whyMissing } from "./compile.js";
import { CODE, TRY_AGAIN, type Answer, type Request } from "./jobs.js";

let loading: Promise<unknown> | undefined;

/** What the module must export for this script. */
const WANTED = ["compute", "take_panic"];

/** How often progress is told, milliseconds. */
const TELL_MS = 50;

/** Carries out a request. A page calls this itself only where it may have no workers. */
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
    // The next request may have more luck.
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

// In a worker there is no document.
if (typeof document === "undefined") {
  addEventListener("message", ({ data }: MessageEvent<Request>) => {
    void carryOut(data, (answer, transfer = []) => postMessage(answer, { transfer }));
  });
}
