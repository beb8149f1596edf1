/** Worker of the Lab, which runs one request after another. */

import * as files from "epipole-lab-files";
import * as vision from "epipole-lab-vision";
import type { Branch, Order, WorkerMessage } from "./worker_pool.js";

/** The worker pool passes the module to run in the worker's name. */
const [code, place] =
  (self.name as Branch) === "files" ? ([files, LAB_FILES_WASM] as const) : ([vision, LAB_VISION_WASM] as const);
const { compute, take_panic } = code;
const loading = code.default({ module_or_path: new URL(place, import.meta.url) });

/** Error thrown to leave a canceled computation. */
const STOPPED = new Error("stopped");

/** Minimum interval between progress reports, milliseconds. */
const TELL_MS = 60;

addEventListener("message", ({ data }: MessageEvent<Order>) => {
  void carryOut(data);
});

/** Whether the job is still needed: its URL is readable. A busy worker receives no messages. */
function isWanted(address: string): boolean {
  const request = new XMLHttpRequest();
  request.open("GET", address, false);
  try {
    request.send();
    return true;
  } catch {
    return false;
  }
}

async function carryOut({ work, request, wanted }: Order): Promise<void> {
  const tell = (message: WorkerMessage, transfer: Transferable[] = []) => postMessage(message, { transfer });
  try {
    await loading;
  } catch {
    tell({ work, problem: "the code for this computation could not be loaded; reload the page", broken: true });
    return;
  }
  // A content security policy may forbid the request; cancellation then relies on terminate().
  const canAsk = isWanted(wanted);
  let last = 0;
  const progress = (share: number, words: string) => {
    const now = performance.now();
    if (now - last < TELL_MS) return;
    last = now;
    // Throwing out of the module breaks it, but this worker is about to end.
    if (canAsk && !isWanted(wanted)) throw STOPPED;
    tell({ work, share, words });
  };
  try {
    const soFar = (bytes: Uint8Array) => tell({ work, soFar: bytes }, [bytes.buffer as ArrayBuffer]);
    const answer = compute(request, { progress, soFar });
    tell({ work, answer }, [answer.buffer as ArrayBuffer]);
  } catch (problem) {
    if (problem === STOPPED) {
      tell({ work, problem: "stopped", broken: true });
      close();
      return;
    }
    // A string is an error message; any other error has broken the module.
    if (typeof problem === "string") tell({ work, problem, broken: false });
    else tell({ work, problem: sentence(problem, take_panic()), broken: true });
  }
}

/** Returns the message for a module that stopped midway. Without a panic, its memory could not grow. */
function sentence(problem: unknown, panic: string | undefined): string {
  console.warn(panic ?? problem);
  return panic === undefined
    ? "there is not enough memory for this: reduce photographs to fewer megapixels, or close other pages and try again"
    : "this is a mistake of the Lab, not of your photographs: try again, or try other settings";
}
