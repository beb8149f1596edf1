/** The long computations of one figure: in a worker, one after the other, only the newest wanted. */

import { make, setText } from "./dom.js";

/** What a worker is asked. */
export interface Request {
  name: string;
  key: string;
  request: Uint8Array;
}

/** What it answers: how far it is, and in the end a result or a sentence. */
export type Answer = { key: string } & (
  | { share: number }
  | { result: Uint8Array }
  | { problem: string }
);

export interface JobHooks {
  /** The computation that the figure waits for, as it stands. */
  next: () => Request | undefined;
  done: (key: string, result: Uint8Array) => void;
  failed: (key: string, sentence: string) => void;
}

/** A computation that nobody wants any more may go on for so long; then its worker is ended. */
const PATIENCE_MS = 400;
/** Quick computations come and go without a word. */
const QUIET_MS = 200;

export class Jobs {
  /** What is being computed, how far it is, and a button to stop it. */
  readonly element = make("div", { class: "job", hidden: true });
  readonly #label = make("span");
  readonly #bar = make("progress", { max: 1, "aria-label": "Progress" });
  readonly #button = make("button", { type: "button" }, "Stop");
  readonly #hooks: JobHooks;
  #worker: Worker | undefined;
  #running: { key: string; since: number } | undefined;
  #stopped: string | undefined;
  #words = "";
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(hooks: JobHooks) {
    this.#hooks = hooks;
    this.element.append(this.#label, this.#bar, this.#button);
    this.#button.addEventListener("click", () => (this.#stopped ? this.#goOn() : this.#stop()));
  }

  /** Looks what the figure waits for; `words` say it, and are absent if it waits for nothing. */
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

  /** Ends everything. */
  end(): void {
    this.#worker?.terminate();
    this.#worker = undefined;
    this.#running = undefined;
    this.#stopped = undefined;
    this.#show(false);
  }

  /** The running computation is not the one that is wanted: it may end by itself, if it hurries. */
  #overtaken(): void {
    if (this.#running && performance.now() - this.#running.since > PATIENCE_MS) {
      this.#worker?.terminate();
      this.#worker = undefined;
      this.#running = undefined;
    }
  }

  #start(request: Request): void {
    this.#running = { key: request.key, since: performance.now() };
    this.#bar.removeAttribute("value");
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#show(this.#running !== undefined), QUIET_MS);
    try {
      this.#worker ??= this.#hire();
      this.#worker.postMessage(request);
    } catch {
      this.#here(request);
    }
  }

  #hire(): Worker {
    const worker = hire();
    worker.addEventListener("message", ({ data }: MessageEvent<Answer>) => this.#hear(data));
    worker.addEventListener("error", (event) => {
      // The page does not allow workers: then here, and the page waits.
      event.preventDefault();
      const request = this.#running && this.#hooks.next();
      this.#running = this.#worker = undefined;
      if (request) this.#here(request);
    });
    return worker;
  }

  #here(request: Request): void {
    this.#running = { key: request.key, since: performance.now() };
    this.#show(true);
    const { key } = request;
    setTimeout(() => {
      const script: Promise<typeof import("./worker.js")> = import(workerUrl().href);
      script.then(
        ({ carryOut }) => carryOut(request, (answer) => this.#hear(answer)),
        (problem: unknown) => this.#hear({ key, problem: String(problem) }),
      );
    }, 50);
  }

  #hear(answer: Answer): void {
    if (answer.key !== this.#running?.key) return;
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

  /** Ends a slow computation that the figure does not wait for any more, and starts the right one. */
  #checkWanted(): void {
    const next = this.#hooks.next();
    if (next?.key === this.#running?.key) return;
    this.#overtaken();
    if (next && !this.#running) this.#start(next);
  }

  #stop(): void {
    const key = this.#running?.key;
    this.end();
    this.#stopped = key;
    this.#show(true);
  }

  #goOn(): void {
    this.#stopped = undefined;
    this.follow(this.#words);
  }

  #show(shown: boolean): void {
    if (!shown) clearTimeout(this.#timer);
    this.element.hidden = !shown;
    setText(this.#label, this.#stopped ? `${this.#words}: stopped` : `${this.#words} …`);
    setText(this.#button, this.#stopped ? "Go on" : "Stop");
    this.#bar.hidden = this.#stopped !== undefined;
  }
}

function workerUrl(): URL {
  return new URL(EPIPOLE_WORKER, import.meta.url);
}

/** A worker may only be started from the page's own origin; from elsewhere it takes one hop. */
function hire(): Worker {
  const url = workerUrl();
  if (url.origin === location.origin) return new Worker(url, { type: "module" });
  const hop = new Blob([`import ${JSON.stringify(url.href)};`], { type: "text/javascript" });
  return new Worker(URL.createObjectURL(hop), { type: "module" });
}
