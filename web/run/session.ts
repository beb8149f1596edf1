/** One run of a reader's code: a separate worker, and a module that exists as long as the run. */

import type { Fault, FromWorker, Item, Question, Reply, ToWorker } from "./messages.js";
import { firstMistake, type Prepared } from "./source.js";

/** Time after which a run is reported as long, milliseconds. */
const LONG_MS = 5000;

/** Callbacks of a run. */
export interface Listener {
  items(items: readonly Item[]): void;
  /** Called if the code throws or cannot be parsed. Ends the run. */
  failed(fault: Fault): void;
  /** Called at the end, with the duration in milliseconds and the verdict of its check. */
  finished(duration: number, verdict: string | undefined): void;
  /** Called if it is still running after five seconds. */
  lasts(): void;
  answer(question: Question): Promise<Reply>;
}

export class Session {
  readonly #worker: Worker;
  readonly #url: string;
  readonly #start = performance.now();
  #timer: ReturnType<typeof setTimeout> | undefined;
  #verdict: string | undefined;

  constructor(code: string, { text, shift }: Prepared, listener: Listener) {
    this.#url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    this.#worker = new Worker(this.#url, { type: "module" });
    this.#timer = setTimeout(() => listener.lasts(), LONG_MS);
    const fail = (fault: Fault) => {
      this.stop();
      listener.failed(fault);
    };
    const inCode = (fault: Fault): Fault => {
      const column = fault.line === 1 && fault.column ? Math.max(1, fault.column - shift) : fault.column;
      // The lines after the code are not the reader's.
      const isInside = fault.line !== undefined && fault.line <= code.split("\n").length;
      return isInside ? { ...fault, column } : { name: fault.name, message: fault.message };
    };
    this.#worker.addEventListener("message", ({ data }: MessageEvent<FromWorker>) => {
      if (data.type === "items") listener.items(data.items);
      else if (data.type === "fault") fail(inCode(data.fault));
      else if (data.type === "verdict") this.#verdict = data.text;
      else if (data.type === "done") {
        this.stop();
        listener.finished(performance.now() - this.#start, this.#verdict);
      } else void this.#reply(data.id, listener.answer(data.question));
    });
    // Errors of the running code arrive as messages; this one means that it did not start.
    this.#worker.addEventListener("error", (event) => {
      event.preventDefault();
      const { message, lineno: line, colno: column } = event;
      const said = /^(?:Uncaught )?(\w*Error): (.*)$/s.exec(message ?? "");
      if (said) fail(inCode({ name: said[1] ?? "Error", message: said[2] ?? "", line, column }));
      else fail(firstMistake(code));
    });
  }

  async #reply(id: number, answer: Promise<Reply>): Promise<void> {
    const message: ToWorker = await answer.then(
      (reply) => ({ id, reply }),
      (problem: Error) => ({ id, problem: problem.message }),
    );
    this.#worker.postMessage(message);
  }

  stop(): void {
    clearTimeout(this.#timer);
    this.#worker.terminate();
    URL.revokeObjectURL(this.#url);
  }
}
