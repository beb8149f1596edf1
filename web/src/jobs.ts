/** Long computations of a figure in a worker: one at a time, the newest wins. */

import { movedTo } from "./assets.js";
import { make, setText } from "./dom.js";

/** Message to a worker. */
export interface Request {
  name: string;
  key: string;
  request: Uint8Array;
  /** Address of the module, if it is not beside the worker. */
  module: string | undefined;
  /** Whether to bypass the cache, because an earlier attempt failed. */
  anew: boolean;
}

/** Message from a worker: progress, and finally a result or an error. */
export type Answer = { key: string } & (
  | { share: number }
  | { result: Uint8Array }
  | { problem: string; missing?: boolean }
);

/** Computation that a figure waits for; `request` creates its large input on demand. */
export interface Wanted {
  name: string;
  key: string;
  request: () => Uint8Array;
}

/** Text for a worker or module that could not be loaded. */
export const CODE = "the code for this computation";
export const TRY_AGAIN = "Reset tries again";

export interface JobHooks {
  /** Returns the computation that the figure currently waits for. */
  next: () => Wanted | undefined;
  done: (key: string, result: Uint8Array) => void;
  failed: (key: string, sentence: string) => void;
  /** Called when the reader has stopped or resumed it. */
  turned?: () => void;
}

/** Time after which an outdated computation is terminated, milliseconds. */
const PATIENCE_MS = 400;
/** Time without an answer after which the code is reported as slow to load, milliseconds. */
const SILENCE_MS = 15_000;
/** Delay before progress is shown, milliseconds. */
const QUIET_MS = 200;

export class Jobs {
  /** Name, progress and a button to stop the computation. */
  readonly element = make("div", { class: "job", hidden: true });
  readonly #label = make("span");
  readonly #bar = make("progress", { max: 1, "aria-label": "Progress" });
  readonly #button = make("button", { type: "button" }, "Stop");
  readonly #hooks: JobHooks;
  #worker: Worker | undefined;
  #running: { key: string; since: number } | undefined;
  #stopped: string | undefined;
  /** Whether the code is slow to load. */
  #late = false;
  /** Number of consecutive failures to load it. */
  #misses = 0;
  #words = "";
  #timer: ReturnType<typeof setTimeout> | undefined;
  #silence: ReturnType<typeof setTimeout> | undefined;

  constructor(hooks: JobHooks) {
    this.#hooks = hooks;
    this.element.append(this.#label, this.#bar, this.#button);
    this.#button.addEventListener("click", () => {
      if (this.#stopped === undefined && !this.#late) this.#stop();
      else this.goOn();
    });
  }

  /** Starts the computation that the figure waits for, with its name; null if there is none. */
  follow(words: string | null): void {
    if (words === null) {
      if (this.#running) this.#overtaken();
      this.#stopped = undefined;
      this.#show(false);
      return;
    }
    this.#words = words;
    const next = this.#hooks.next();
    if (!next || next.key === this.#running?.key || next.key === this.#stopped) return;
    this.#stopped = undefined;
    if (this.#running) this.#overtaken();
    if (!this.#running) this.#start(next);
  }

  get busy(): boolean {
    return this.#running !== undefined;
  }

  /** Whether the reader has stopped the current computation. */
  get stopped(): boolean {
    return this.#stopped !== undefined;
  }

  /** Ends everything. */
  end(): void {
    this.#dismiss();
    this.#stopped = undefined;
    this.#show(false);
  }

  /** Restarts a computation that was stopped, or whose code was never loaded. */
  goOn(): void {
    if (this.#stopped === undefined && !this.#late) return;
    if (this.#late) this.#misses += 1;
    this.end();
    this.follow(this.#words);
    this.#hooks.turned?.();
  }

  #dismiss(): void {
    if (this.#worker) {
      // A browser may keep a worker that was terminated while loading; it must not keep the figure.
      this.#worker.onmessage = this.#worker.onerror = null;
      this.#worker.terminate();
    }
    this.#worker = undefined;
    this.#running = undefined;
    this.#late = false;
    clearTimeout(this.#silence);
  }

  /** Terminates an outdated computation, unless it has just started and may end by itself. */
  #overtaken(): void {
    if (this.#running && performance.now() - this.#running.since > PATIENCE_MS) this.#dismiss();
  }

  #start(wanted: Wanted): void {
    this.#running = { key: wanted.key, since: performance.now() };
    this.#bar.removeAttribute("value");
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#show(this.#running !== undefined), QUIET_MS);
    this.#listen();
    try {
      this.#worker ??= this.#hire();
    } catch {
      this.#here(wanted);
      return;
    }
    const { name, key } = wanted;
    const module = movedTo("jobs")?.href;
    const anew = this.#misses > 0;
    this.#worker.postMessage({ name, key, request: wanted.request(), module, anew } satisfies Request);
  }

  /** Reports after a while that no answer has arrived. */
  #listen(): void {
    clearTimeout(this.#silence);
    this.#silence = setTimeout(() => {
      this.#late = this.#running !== undefined;
      this.#show(this.#late);
    }, SILENCE_MS);
  }

  #hire(): Worker {
    const worker = hire(this.#misses);
    worker.onmessage = ({ data }: MessageEvent<Answer>) => this.#hear(data);
    worker.onerror = (event) => {
      // The page does not allow workers, so the computation runs in the page itself.
      event.preventDefault();
      const wanted = this.#running && this.#hooks.next();
      this.#running = this.#worker = undefined;
      if (wanted) this.#here(wanted);
    };
    return worker;
  }

  #here(wanted: Wanted): void {
    const { name, key } = wanted;
    this.#running = { key, since: performance.now() };
    this.#show(true);
    this.#listen();
    setTimeout(() => {
      // Bundlers know the file from `hire`, and must not change its address here.
      const script: Promise<typeof import("./worker.js")> = import(
        /* webpackIgnore: true */ /* @vite-ignore */ workerUrl(this.#misses).href
      );
      script.then(
        ({ carryOut }) => {
          // It may have been stopped while the script was loading.
          if (this.#running?.key !== key) return;
          const module = movedTo("jobs")?.href;
          const anew = this.#misses > 0;
          void carryOut({ name, key, request: wanted.request(), module, anew }, (answer) => this.#hear(answer));
        },
        () => this.#hear({ key, problem: `${CODE} could not be loaded; ${TRY_AGAIN}`, missing: true }),
      );
    }, 50);
  }

  #hear(answer: Answer): void {
    if (answer.key !== this.#running?.key) return;
    clearTimeout(this.#silence);
    this.#misses = "missing" in answer ? this.#misses + 1 : 0;
    if (this.#late) {
      this.#late = false;
      this.#show(true);
    }
    if ("share" in answer) {
      this.#bar.value = answer.share;
      if (performance.now() - this.#running.since > PATIENCE_MS) this.#checkWanted();
      return;
    }
    this.#running = undefined;
    this.#show(false);
    if ("result" in answer) this.#hooks.done(answer.key, answer.result);
    else this.#hooks.failed(answer.key, answer.problem);
  }

  /** Ends a slow computation that the figure no longer waits for, and starts the current one. */
  #checkWanted(): void {
    const next = this.#hooks.next();
    if (next?.key === this.#running?.key) return;
    this.#overtaken();
    if (next && !this.#running) this.#start(next);
  }

  #stop(): void {
    clearTimeout(this.#timer);
    const key = this.#running?.key;
    this.end();
    this.#stopped = key;
    this.#show(true);
    this.#hooks.turned?.();
  }

  #show(shown: boolean): void {
    if (!shown) clearTimeout(this.#timer);
    this.element.hidden = !shown;
    const stopped = this.#stopped !== undefined;
    const state = stopped ? ": stopped" : this.#late ? ": the code for it is slow to come" : " …";
    setText(this.#label, this.#words + state);
    setText(this.#button, stopped ? "Go on" : this.#late ? "Try again" : "Stop");
    this.#bar.hidden = stopped || this.#late;
  }
}

/**
 * Returns the address of the worker; a different one after each failure, because browsers cache failed and hanging
 * requests.
 */
function workerUrl(misses: number): URL {
  const url = movedTo("worker") ?? new URL(EPIPOLE_WORKER, import.meta.url);
  if (misses > 0 && url.protocol.startsWith("http")) url.searchParams.set("again", String(misses));
  return url;
}

/** Starts a worker; from another origin, by a script that imports it. */
function hire(misses: number): Worker {
  const url = workerUrl(misses);
  // A sandboxed frame has an address, but an opaque origin.
  const own = url.origin === globalThis.origin;
  if (own && (misses > 0 || movedTo("worker"))) return new Worker(url, { type: "module" });
  if (own) {
    // Written in the form by which bundlers find the worker's file.
    return new Worker(new URL(EPIPOLE_WORKER, import.meta.url), { type: "module" });
  }
  const hop = new Blob([`import ${JSON.stringify(url.href)};`], { type: "text/javascript" });
  return new Worker(URL.createObjectURL(hop), { type: "module" });
}
