/** The bindings that wasm-bindgen generates from `crates/epipole-lab`, for the page. */
declare module "epipole-lab-page" {
  export class Lab {
    constructor();
    start(
      canvas: HTMLCanvasElement,
      shell: {
        capacity(): number;
        start(work: number, request: Uint8Array): void;
        cancel(work: number): void;
        askForPhotographs(): void;
        askForProject(): void;
        save(name: string, bytes: Uint8Array): void;
        say(words: string): void;
      },
    ): Promise<void>;
    progress(work: number, share: number, words: string): void;
    done(work: number, answer: Uint8Array): void;
    failed(work: number, sentence: string): void;
    photograph(name: string, bytes: Uint8Array): void;
    deliver(): void;
    project(archive: Uint8Array): void;
    dark(dark: boolean): void;
    widgets(): string | undefined;
    operate(widget: string, value?: number): void;
    panic(): string | undefined;
  }
  export default function load(options: { module_or_path: URL }): Promise<unknown>;
}

/** The bindings for its workers. */
declare module "epipole-lab-worker" {
  export function compute(
    request: Uint8Array,
    listener: { progress: (share: number, words: string) => void },
  ): Uint8Array;
  export function take_panic(): string | undefined;
  export default function load(options: { module_or_path: URL }): Promise<unknown>;
}

/** Where the modules and the worker's script are, relative to the script; the bundler puts them in. */
declare const LAB_PAGE_WASM: string;
declare const LAB_WORKER_WASM: string;
declare const LAB_WORKER: string;
