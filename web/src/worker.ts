/** Long computations, away from the page: one request at a time, one answer each. */

import load, { compute, take_panic } from "epipole-web";
import type { Answer, Request } from "./jobs.js";

const loading = load({ module_or_path: new URL(EPIPOLE_WASM, import.meta.url) });

/** How often progress is told, milliseconds. */
const TELL_MS = 50;

function answer(message: Answer, transfer: Transferable[] = []): void {
  postMessage(message, { transfer });
}

addEventListener("message", (event: MessageEvent<Request>) => void work(event.data));

async function work({ name, key, request }: Request): Promise<void> {
  let told = 0;
  const progress = (share: number) => {
    const now = performance.now();
    if (now - told < TELL_MS) return;
    told = now;
    answer({ key, share });
  };
  try {
    await loading;
    const result = compute(name, request, { progress });
    answer({ key, result }, [result.buffer as ArrayBuffer]);
  } catch (problem) {
    const sentence = typeof problem === "string" ? problem : take_panic() ?? String(problem);
    answer({ key, problem: sentence });
  }
}
