/** Browser storage of the Lab: files for a reload, and a project for as long as the reader wants. */

import { erase, get, put } from "./store.js";

/** Database of files to restore after a reload; erased once they are read. */
const ASIDE = "epipole-lab";
/** Database of the project that the reader chose to store. */
const KEPT = "epipole-lab-kept";

/** Stores files. Throws if storage is blocked or full. */
export function putAside(files: readonly File[]): Promise<void> {
  return put(ASIDE, [...files]);
}

/** Returns the stored files and erases them. */
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

/** Callbacks for changes of the stored project. */
interface Listener {
  kept(numBytes: number): void;
  notKept(why: string, isThere: boolean): void;
  forgotten(): void;
}

/** Project that the reader chose to store. */
export class StoredProject {
  readonly #listener: Listener;
  /** Other open pages of the Lab; a project erased in one must not be stored again by another. */
  readonly #others = new BroadcastChannel(KEPT);
  /** Last queued operation. Operations run in order, so that none reverts a later erasure. */
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

  /** Whether a project is stored, to be restored after a restart. */
  get isThere(): boolean {
    return this.#isThere;
  }

  /** Resolves when all queued operations are done. */
  get settled(): Promise<void> {
    return this.#last;
  }

  /** Stops storing: queued operations finish, later calls do nothing. */
  close(): void {
    this.#isClosed = true;
  }

  /** Stores a project, replacing the previous one. */
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

  /** Returns the stored project, if any. Throws an `Error` with a message for the reader. */
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
      // With storage blocked, nothing can have been stored.
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
