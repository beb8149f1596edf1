/** What the browser keeps: files over one reload after the Lab has stopped, and a project for as long as the reader chooses. */

import { erase, get, put } from "./store.js";

/** What a reader gave, forgotten as soon as it is there again. */
const ASIDE = "epipole-lab";
/** The project that the reader chose to keep. */
const KEPT = "epipole-lab-kept";

/** Puts files aside. Throws where the browser keeps nothing. */
export function putAside(files: readonly File[]): Promise<void> {
  return put(ASIDE, [...files]);
}

/** Takes what was put aside, and leaves nothing behind. */
export async function takeBack(): Promise<File[]> {
  try {
    const files = await get(ASIDE);
    if (files === undefined) return [];
    await erase(ASIDE);
    return Array.isArray(files) ? files : [];
  } catch {
    return [];
  }
}

/** Who hears what became of the project that is kept. */
interface Listener {
  kept(numBytes: number): void;
  notKept(why: string, isThere: boolean): void;
  forgotten(): void;
}

/** The project that the reader chose to keep. */
export class Kept {
  readonly #listener: Listener;
  /** Other pages of the Lab that are open: one of them must not keep again what another one has forgotten. */
  readonly #others = new BroadcastChannel(KEPT);
  /** One after the other: what is forgotten must not be put there afterwards. */
  #last: Promise<void> = Promise.resolve();
  #isThere = false;
  #isClosed = false;

  constructor(listener: Listener) {
    this.#listener = listener;
    this.#others.onmessage = () => {
      this.#isThere = false;
      listener.forgotten();
    };
  }

  /** Whether this page can bring back the project after a restart. */
  get isThere(): boolean {
    return this.#isThere;
  }

  /** Ends when everything that was asked for is done. */
  get settled(): Promise<void> {
    return this.#last;
  }

  /** What was asked for is done; from now on nothing more is kept. */
  close(): void {
    this.#isClosed = true;
  }

  /** Keeps a project in place of the one before. */
  keep(project: Uint8Array, then: () => void): void {
    if (this.#isClosed) return;
    this.#next(async () => {
      try {
        await put(KEPT, new Blob([project as BlobPart]));
        this.#isThere = true;
        then();
        this.#listener.kept(project.length);
      } catch (error) {
        console.warn(error);
        this.#listener.notKept(why(error, project.length), this.#isThere);
      }
    });
  }

  forget(): void {
    this.#next(async () => {
      try {
        await erase(KEPT);
        this.#isThere = false;
        this.#others.postMessage("forgotten");
      } catch (error) {
        console.warn(error);
        this.#listener.notKept("it could not be erased; the browser's settings for this page erase it.", this.#isThere);
      }
    });
  }

  /** The project, if there is one. Throws an `Error` whose message is a sentence for the reader. */
  async read(): Promise<Uint8Array | undefined> {
    let kept: unknown;
    try {
      await this.#last;
      kept = await get(KEPT);
      if (kept === undefined) return undefined;
      this.#isThere = true;
      if (kept instanceof Blob) return new Uint8Array(await kept.arrayBuffer());
    } catch (error) {
      console.warn(error);
      // Where nobody may look there is nothing of ours.
      if (!this.#isThere) return undefined;
    }
    throw new Error("The project that this browser keeps cannot be read any more. Forget it in the Project menu.");
  }

  #next(what: () => Promise<void>): void {
    this.#last = this.#last.then(what);
  }
}

function why(error: unknown, numBytes: number): string {
  if (error instanceof DOMException && error.name === "QuotaExceededError") {
    return `there is no room for ${(numBytes / 1e6).toFixed(1)} MB.`;
  }
  return "it does not let this page keep anything.";
}
