/** Runs calls in a worker. */

import type { Part } from "./api.js";
import { errorOf } from "./errors.js";
import type { Answer, Call } from "./messages.js";

/** A call with its control options. */
export interface Job {
  part: Part;
  /** Function name; undefined to only load the part. */
  name?: string;
  given: readonly unknown[];
  signal?: AbortSignal | undefined;
  progress?: ((stage: string, fraction: number) => void) | undefined;
}

export interface Runner {
  run(job: Job): Promise<unknown>;
  close(): void;
  /** Closes once no call is running. */
  closeLater(): void;
}

/** Creates the error for calls after the end. */
export const closed = () => new Error("this Vision is closed");

/** A worker of the browser or of Node. */
export interface Port {
  post(call: Call): void;
  terminate(): void;
  /** Sets whether the process waits for it. */
  hold(isHeld: boolean): void;
}

/** Starts a worker, given callbacks for its answers and its end. */
export type Start = (onAnswer: (answer: Answer) => void, onEnd: (why: string) => void) => Port;

interface Waiting extends Job {
  id: number;
  settle(result: unknown): void;
  fail(problem: unknown): void;
}

/** Runs calls in a worker, one after the other. Aborting a call terminates the worker; the next call starts another. */
export class WorkerRunner implements Runner {
  readonly #start: Start;
  #port: Port | undefined;
  #running: Waiting | undefined;
  #queue: Waiting[] = [];
  #nextId = 1;
  #isClosed = false;
  #isLast = false;

  constructor(start: Start) {
    this.#start = start;
  }

  run(job: Job): Promise<unknown> {
    return new Promise((resolve, reject) => {
      if (this.#isClosed) throw closed();
      job.signal?.throwIfAborted();
      const onAbort = () => this.#abort(waiting);
      const release = () => job.signal?.removeEventListener("abort", onAbort);
      const waiting: Waiting = {
        ...job,
        id: this.#nextId++,
        settle: (result) => (release(), resolve(result)),
        fail: (problem) => (release(), reject(problem)),
      };
      job.signal?.addEventListener("abort", onAbort);
      this.#queue.push(waiting);
      this.#next();
    });
  }

  #next(): void {
    if (this.#running !== undefined) return;
    const job = this.#queue.shift();
    if (job === undefined) {
      this.#port?.hold(false);
      if (this.#isLast) this.close();
      return;
    }
    this.#running = job;
    const { id, part, name, given, progress } = job;
    try {
      this.#port ??= this.#start(
        (answer) => this.#hear(answer),
        (why) => this.#end(new Error(`the worker has stopped: ${why}`)),
      );
      this.#port.hold(true);
      this.#port.post({ id, part, name, given, reports: progress !== undefined });
    } catch (cause) {
      const why = cause instanceof Error ? cause.message : String(cause);
      this.#done(() => job.fail(new TypeError(`${name ?? part} cannot run in a worker: ${why}`, { cause })));
    }
  }

  #hear(answer: Answer): void {
    const job = this.#running;
    if (job === undefined || answer.id !== job.id) return;
    if ("stage" in answer) {
      try {
        job.progress?.(answer.stage, answer.fraction);
      } catch (problem) {
        this.#end(problem);
      }
    } else if ("fault" in answer) {
      // A module that has stopped must not be used again.
      if (answer.fault[0] === "Error") this.#end(errorOf(answer.fault));
      else this.#done(() => job.fail(errorOf(answer.fault)));
    } else this.#done(() => job.settle(answer.result));
  }

  #abort(job: Waiting): void {
    if (this.#running === job) this.#end(job.signal?.reason);
    else {
      this.#queue = this.#queue.filter((other) => other !== job);
      job.fail(job.signal?.reason);
    }
  }

  /** Terminates the worker with the running call. */
  #end(problem: unknown): void {
    this.#port?.terminate();
    this.#port = undefined;
    const job = this.#running;
    if (job !== undefined) this.#done(() => job.fail(problem));
  }

  #done(settle: () => void): void {
    this.#running = undefined;
    settle();
    this.#next();
  }

  close(): void {
    this.#isClosed = true;
    this.#port?.terminate();
    this.#port = undefined;
    const jobs = [...(this.#running ? [this.#running] : []), ...this.#queue];
    this.#running = undefined;
    this.#queue = [];
    for (const job of jobs) job.fail(closed());
  }

  closeLater(): void {
    this.#isLast = true;
    this.#next();
  }
}
