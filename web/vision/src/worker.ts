/** Worker script: one call at a time, each with one answer. */

import { faultOf } from "./errors.js";
import { callPart, loadPart } from "./host.js";
import type { Answer, Call } from "./messages.js";

async function answer({ id, part, name, given, reports }: Call, post: Post): Promise<void> {
  try {
    const loaded = await loadPart(part);
    if (name === undefined) {
      post({ id, result: undefined }, []);
      return;
    }
    const report = (stage: string, fraction: number) => {
      post({ id, stage, fraction }, []);
      return true;
    };
    const result = callPart(loaded, name, given, reports ? report : undefined);
    post({ id, result }, buffers(result));
  } catch (problem) {
    post({ id, fault: faultOf(problem) }, []);
  }
}

/** Returns the buffers of all typed arrays in a result, to transfer instead of copying. */
function buffers(value: unknown, found: ArrayBuffer[] = []): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) found.push(value.buffer as ArrayBuffer);
  else if (typeof value === "object" && value !== null) {
    for (const part of Object.values(value)) buffers(part, found);
  }
  return found;
}

type Post = (answer: Answer, transfer: ArrayBuffer[]) => void;

if (typeof self === "object" && typeof self.postMessage === "function") {
  const post: Post = (message, transfer) => self.postMessage(message, { transfer });
  self.addEventListener("message", ({ data }: MessageEvent<Call>) => void answer(data, post));
} else {
  const name = "node:worker_threads";
  const loading = import(/* webpackIgnore: true */ /* @vite-ignore */ name) as Promise<typeof import("node:worker_threads")>;
  void loading.then(({ parentPort }) => {
    const post: Post = (message, transfer) => parentPort?.postMessage(message, transfer);
    parentPort?.on("message", (call: Call) => void answer(call, post));
  });
}
