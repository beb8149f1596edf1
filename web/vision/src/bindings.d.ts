/** Script of a part's module. */
declare module "*.part.js" {
  const load: import("./source.js").Bindings["default"];
  export default load;
  export const call: import("./source.js").Bindings["call"];
}

/** Modules of Node, as far as they are used. */
declare module "node:fs/promises" {
  export function readFile(url: URL): Promise<Uint8Array<ArrayBuffer>>;
}
declare module "node:worker_threads" {
  export class Worker {
    constructor(url: URL, options: { execArgv: string[] });
    on(event: string, listener: (value: never) => void): void;
    postMessage(message: unknown): void;
    terminate(): Promise<number>;
    ref(): void;
    unref(): void;
  }
  export const parentPort: {
    on(event: "message", listener: (value: never) => void): void;
    postMessage(message: unknown, transfer: readonly ArrayBuffer[]): void;
  } | null;
}
