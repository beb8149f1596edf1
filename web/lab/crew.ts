/** The workers of the Lab: each does one piece of work at a time; idle ones end after a while. */

export interface Order {
  work: number;
  request: Uint8Array;
  /** An address that can be read as long as the work is wanted: a worker that computes hears of nothing else. */
  wanted: string;
}

export type Told = { work: number } & (
  | { share: number; words: string }
  | { soFar: Uint8Array }
  | { answer: Uint8Array }
  | { problem: string; broken: boolean }
);

/** Which module a worker has. */
export type Branch = "vision" | "files";

interface Member {
  worker: Worker;
  branch: Branch;
  work: number | undefined;
  wanted: string;
  idleSince: number;
}

/** A worker without work ends after so long. */
const IDLE_MS = 20_000;

export class Crew {
  readonly capacity: number;
  readonly #members: Member[] = [];
  readonly #hear: (told: Told) => void;

  constructor(hear: (told: Told) => void) {
    this.#hear = hear;
    this.capacity = Math.min(6, Math.max(1, navigator.hardwareConcurrency || 2));
    setInterval(() => this.#tidy(), IDLE_MS / 2);
  }

  start(work: number, branch: Branch, request: Uint8Array): void {
    const idle = this.#members.filter((other) => other.work === undefined);
    const fit = idle.find((other) => other.branch === branch);
    // Never more than can work at once: one that waits for other work makes room.
    if (!fit && this.#members.length >= this.capacity && idle[0]) this.#dismiss(idle[0]);
    const member = fit ?? this.#hire(branch);
    member.work = work;
    member.wanted = URL.createObjectURL(new Blob());
    const order: Order = { work, request, wanted: member.wanted };
    member.worker.postMessage(order, [request.buffer as ArrayBuffer]);
  }

  /** Its worker is ended, and told so: Chromium lets one that computes go on for up to two seconds. */
  cancel(work: number): void {
    const member = this.#members.find((other) => other.work === work);
    if (member) this.#dismiss(member);
  }

  #hire(branch: Branch): Member {
    const worker = new Worker(new URL(LAB_WORKER, import.meta.url), { type: "module", name: branch });
    const member: Member = { worker, branch, work: undefined, wanted: "", idleSince: performance.now() };
    worker.onmessage = ({ data }: MessageEvent<Told>) => {
      if (!("share" in data || "soFar" in data)) {
        member.work = undefined;
        URL.revokeObjectURL(member.wanted);
        member.idleSince = performance.now();
      }
      this.#hear(data);
      // Then the module is in no state to go on.
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
