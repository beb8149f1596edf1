/** Loads the modules of the parts and calls them, in this thread. */

import { LARGER, type Part } from "./api.js";
import { PARTS } from "./parts.js";
import type { Bindings } from "./source.js";

/** Callback with stage and fraction done; cancels by returning false. */
export type Report = (stage: string, fraction: number) => boolean;

/** A part with its functions. */
export interface Loaded {
  part: Part;
  bindings: Bindings;
}

const loading = new Map<Part, Promise<Loaded>>();
const broken = new Set<Part>();

/** Loads a part once, unless one that contains it is loaded; after a failure, the next call tries again. */
export function loadPart(part: Part): Promise<Loaded> {
  for (const name of [part, ...LARGER[part]]) {
    const loaded = loading.get(name);
    if (loaded !== undefined) return loaded;
  }
  const loaded = load(part);
  loading.set(part, loaded);
  loaded.catch(() => loading.delete(part));
  return loaded;
}

async function load(part: Part): Promise<Loaded> {
  if (typeof WebAssembly === "undefined") throw new Error("WebAssembly is not available here");
  const { script, wasm } = PARTS[part];
  try {
    await script.default({ module_or_path: await compile(wasm()) });
    return { part, bindings: script };
  } catch (cause) {
    const why = cause instanceof Error ? cause.message : String(cause);
    throw new Error(`the part ${part} cannot be loaded: ${why}`, { cause });
  }
}

async function compile(url: URL): Promise<WebAssembly.Module> {
  if (url.protocol === "file:") {
    // A variable, so that bundlers for browsers do not resolve the import.
    const name = "node:fs/promises";
    const fs = (await import(/* webpackIgnore: true */ /* @vite-ignore */ name)) as typeof import("node:fs/promises");
    return WebAssembly.compile(await fs.readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url.href} answers ${response.status}`);
  // Some servers send another type, which streaming compilation rejects.
  if (response.headers.get("content-type")?.startsWith("application/wasm")) {
    return WebAssembly.compileStreaming(response);
  }
  return WebAssembly.compile(await response.arrayBuffer());
}

/** Calls a function of a loaded part. Throws a fault, or the error of a module that stops. */
export function callPart({ part, bindings }: Loaded, name: string, given: readonly unknown[], report?: Report): unknown {
  if (broken.has(part)) throw new Error(`the part ${part} has stopped: use a worker, or reload the page`);
  try {
    return bindings.call(name, given, report);
  } catch (problem) {
    if (!(problem instanceof WebAssembly.RuntimeError)) throw problem;
    broken.add(part);
    throw new Error(`${name} has stopped: ${problem.message} (out of memory?)`, { cause: problem });
  }
}
