/** Workers of the browser and of Node. */

import type { Answer, Call } from "./messages.js";
import type { Start } from "./runner.js";

/** Whether this is a page, which a long call would block. */
export const isPage = (): boolean => typeof document === "object" && typeof Worker === "function";

/** Returns a function that starts workers in this environment. Rejects if there are none. */
export async function findStart(): Promise<Start> {
  if (typeof Worker === "function") return startWorker;
  const name = "node:worker_threads";
  let node: typeof import("node:worker_threads");
  try {
    node = (await import(/* webpackIgnore: true */ /* @vite-ignore */ name)) as typeof node;
  } catch (cause) {
    throw new Error("there are no workers here: load with { worker: false }", { cause });
  }
  return (onAnswer, onEnd) => {
    // Without the arguments of this process, some of which workers reject, such as --input-type.
    const worker = new node.Worker(new URL("./worker.js", import.meta.url), { execArgv: [] });
    worker.on("message", (answer: Answer) => onAnswer(answer));
    worker.on("error", (problem: Error) => onEnd(problem.message));
    return {
      post: (call: Call) => worker.postMessage(call),
      terminate: () => void worker.terminate(),
      hold: (isHeld) => (isHeld ? worker.ref() : worker.unref()),
    };
  };
}

const startWorker: Start = (onAnswer, onEnd) => {
  const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  worker.addEventListener("message", ({ data }: MessageEvent<Answer>) => onAnswer(data));
  worker.addEventListener("messageerror", () => onEnd("a message cannot be read"));
  worker.addEventListener("error", ({ message }) => onEnd(message || "its script cannot be loaded"));
  return {
    post: (call: Call) => worker.postMessage(call),
    terminate: () => worker.terminate(),
    hold: () => undefined,
  };
};
