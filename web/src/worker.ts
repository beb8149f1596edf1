/** Long computations, away from the page: one request at a time, one answer each. */

import load, { compute, take_panic } from "epipole-jobs";
import { NOT_LOADED, type Answer, type Request } from "./jobs.js";

let loading: Promise<unknown> | undefined;

/** How often progress is told, milliseconds. */
const TELL_MS = 50;

/** Carries out a request. A page calls this itself only where it may have no workers. */
export async function carryOut(
  { name, key, request, module }: Request,
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
    loading ??= load({ module_or_path: module ? new URL(module) : new URL(EPIPOLE_JOBS_WASM, import.meta.url) });
    await loading;
  } catch {
    // The next request may have more luck.
    loading = undefined;
    tell({ key, problem: NOT_LOADED });
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
