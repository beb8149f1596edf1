/** Carries out the requests of the Lab, one after the other. */

import load, { compute, take_panic } from "epipole-lab-worker";
import type { Order, Told } from "./crew.js";

const loading = load({ module_or_path: new URL(LAB_WORKER_WASM, import.meta.url) });

/** How often progress is told, milliseconds. */
const TELL_MS = 60;

addEventListener("message", ({ data: { work, request } }: MessageEvent<Order>) => {
  void carryOut(work, request);
});

async function carryOut(work: number, request: Uint8Array): Promise<void> {
  const tell = (told: Told, transfer: Transferable[] = []) => postMessage(told, { transfer });
  try {
    await loading;
  } catch {
    tell({ work, problem: "the code for this computation could not be loaded; reload the page" });
    return;
  }
  let last = 0;
  const progress = (share: number, words: string) => {
    const now = performance.now();
    if (now - last < TELL_MS) return;
    last = now;
    tell({ work, share, words });
  };
  try {
    const answer = compute(request, { progress });
    tell({ work, answer }, [answer.buffer as ArrayBuffer]);
  } catch (problem) {
    const sentence = typeof problem === "string" ? problem : take_panic() ?? String(problem);
    tell({ work, problem: sentence });
  }
}
