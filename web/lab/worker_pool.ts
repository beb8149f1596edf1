/** The Lab's worker pool: one job per worker; idle workers are terminated after a while. */

export interface Order {
  work: number;
  request: Uint8Array;
  /** Blob URL that is revoked on cancellation: a busy worker receives no messages, but can read a URL. */
  wanted: string;
}

export type WorkerMessage = { work: number } & (
  | { share: number; words: string }
  | { soFar: Uint8Array }
  | { answer: Uint8Array }
  | { problem: string; broken: boolean }
);

/** Module that a worker runs. */
export type Branch = "vision" | "files";

interface Member {
  worker: Worker;
  branch: Branch;
  work: number | undefined;
  wanted: string;
  idleSince: number;
}

/** Idle time after which a worker is terminated, milliseconds. */
const IDLE_MS = 20_000;

export class WorkerPool {
  readonly capacity: number;
  readonly #members: Member[] = [];
  readonly #hear: (message: WorkerMessage) => void;

  constructor(hear: (message: WorkerMessage) => void) {
    this.#hear = hear;
    this.capacity = Math.min(6, Math.max(1, navigator.hardwareConcurrency || 2));
    setInterval(() => this.#tidy(), IDLE_MS / 2);
  }

  start(work: number, branch: Branch, request: Uint8Array): void {
    const idle = this.#members.filter((other) => other.work === undefined);
    const fit = idle.find((other) => other.branch === branch);
    // At capacity, an idle worker of the other branch makes room.
    if (!fit && this.#members.length >= this.capacity && idle[0]) this.#dismiss(idle[0]);
    const member = fit ?? this.#hire(branch);
    member.work = work;
    member.wanted = URL.createObjectURL(new Blob());
    const order: Order = { work, request, wanted: member.wanted };
    member.worker.postMessage(order, [request.buffer as ArrayBuffer]);
  }

  /**
   * Cancels a job: terminates its worker and revokes its URL, as Chromium lets a busy worker run
   * for up to two seconds more.
   */
  cancel(work: number): void {
    const member = this.#members.find((other) => other.work === work);
    if (member) this.#dismiss(member);
  }

  #hire(branch: Branch): Member {
    const worker = new Worker(new URL(LAB_WORKER, import.meta.url), { type: "module", name: branch });
    const member: Member = { worker, branch, work: undefined, wanted: "", idleSince: performance.now() };
    worker.onmessage = ({ data }: MessageEvent<WorkerMessage>) => {
      if (!("share" in data || "soFar" in data)) {
        member.work = undefined;
        URL.revokeObjectURL(member.wanted);
        member.idleSince = performance.now();
      }
      this.#hear(data);
      // A broken module cannot be reused.
      if ("problem" in data && data.broken) this.#dismiss(member);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      const { work } = member;
      this.#dismiss(member);
      if (work !== undefined) {
        this.#hear({ work, problem: "the code for this computation could not be loaded; reload the page", broken: true });
      }
    };
    this.#members.push(member);
    return member;
  }

  #dismiss(member: Member): void {
    member.worker.onmessage = member.worker.onerror = null;
    URL.revokeObjectURL(member.wanted);
    member.worker.terminate();
    const place = this.#members.indexOf(member);
    if (place >= 0) this.#members.splice(place, 1);
  }

  #tidy(): void {
    const now = performance.now();
    for (const member of [...this.#members]) {
      if (member.work === undefined && now - member.idleSince > IDLE_MS) this.#dismiss(member);
    }
  }
}
