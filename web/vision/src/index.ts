/// <reference lib="esnext.disposable" preserve="true" />
/** Multi-view geometry in JavaScript: `const vision = await Vision.load()`. */

import { FUNCTIONS, PART_NAMES, type Functions, type Part } from "./api.js";
import { hasPicture, withPixels } from "./pictures.js";
import { findStart, isPage } from "./ports.js";
import { WorkerRunner, type Runner } from "./runner.js";

export { VisionError, type Code } from "./errors.js";
export type * from "./api.js";
export type { Control } from "./control.js";
export type { Picture } from "./pictures.js";

/** Options of `Vision.load`. */
export interface LoadOptions {
  /** Whether calls run in a worker. Default: true in pages, false in Node. */
  worker?: boolean;
  /** Parts to load immediately. Others load with the first call of one of their functions. */
  parts?: readonly Part[];
}

const runners = new WeakMap<Vision, Runner>();
const forgotten = new FinalizationRegistry<Runner>((runner) => runner.closeLater());

export interface Vision extends Functions {}

/** Functions of the library. Each call returns a promise; the first call of a part loads it. */
export class Vision {
  private constructor(runner: Runner) {
    runners.set(this, runner);
    forgotten.register(this, runner);
  }

  /** Creates an instance. Instances are independent of each other. */
  static async load(options: LoadOptions = {}): Promise<Vision> {
    const { worker = isPage(), parts = [], ...unknown } = options;
    for (const name of Object.keys(unknown)) {
      throw new TypeError(`Vision.load has no option ${name}; it has worker, parts`);
    }
    if (typeof worker !== "boolean") throw new TypeError(`worker must be true or false, but is ${String(worker)}`);
    for (const part of parts) {
      if (!PART_NAMES.includes(part)) {
        throw new TypeError(`there is no part ${String(part)}; the parts are ${PART_NAMES.join(", ")}`);
      }
    }
    // A page with a worker does not need the scripts of the modules.
    const runner = worker ? new WorkerRunner(await findStart()) : new (await import("./thread.js")).ThreadRunner();
    const vision = new Vision(runner);
    await Promise.all(parts.map((part) => runner.run({ part, given: [] })));
    return vision;
  }

  /** Ends the worker. Unfinished and later calls reject. */
  close(): void {
    runners.get(this)?.close();
  }
}

export interface Vision extends Disposable {}
if (Symbol.dispose) {
  Object.defineProperty(Vision.prototype, Symbol.dispose, {
    value(this: Vision) {
      this.close();
    },
  });
}

for (const [name, [part, ...parameters]] of Object.entries(FUNCTIONS)) {
  const at = parameters.indexOf("options");
  const value = async function (this: Vision, ...given: unknown[]): Promise<unknown> {
    const runner = runners.get(this);
    if (runner === undefined) throw new TypeError(`${name} is called without its Vision`);
    const nameOf = (index: number) => parameters[index] ?? "an argument";
    given.forEach((value, index) => requireAttached(nameOf(index), value));
    if (given.some(hasPicture)) {
      given = await Promise.all(given.map((value, index) => withPixels(nameOf(index), value)));
    }
    const options = at < 0 ? undefined : given[at];
    if (typeof options !== "object" || options === null) return runner.run({ part, name, given });
    const { signal, progress, ...rest } = options as Record<string, unknown>;
    if (signal !== undefined && !(signal instanceof AbortSignal)) {
      throw new TypeError("options.signal must be an AbortSignal");
    }
    if (progress !== undefined && typeof progress !== "function") {
      throw new TypeError("options.progress must be a function");
    }
    const control = { signal, progress: progress as ((stage: string, fraction: number) => void) | undefined };
    return runner.run({ part, name, given: given.map((value, index) => (index === at ? rest : value)), ...control });
  };
  Object.defineProperty(Vision.prototype, name, { value, writable: true, configurable: true });
}

/** Rejects typed arrays whose buffer was transferred, as they look empty. */
function requireAttached(name: string, value: unknown, depth = 0): void {
  if (ArrayBuffer.isView(value)) {
    if (value.byteLength === 0 && isDetached(value.buffer)) {
      throw new TypeError(`${name} is detached: its buffer was transferred`);
    }
  } else if (typeof value === "object" && value !== null && depth < 4) {
    for (const [key, part] of Object.entries(value)) {
      if (typeof part === "object") requireAttached(`${name}.${key}`, part, depth + 1);
    }
  }
}

function isDetached(buffer: ArrayBufferLike): boolean {
  try {
    return new Uint8Array(buffer).length < 0;
  } catch {
    return true;
  }
}
