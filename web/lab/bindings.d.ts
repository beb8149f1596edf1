/** The bindings that wasm-bindgen generates from `crates/epipole-lab`, for the page. */
declare module "epipole-lab-page" {
  export class Lab {
    constructor();
    start(
      canvas: HTMLCanvasElement,
      shell: {
        capacity(): number;
        start(work: number, branch: string, request: Uint8Array): void;
        cancel(work: number): void;
        bringsSample(): boolean;
        askForPhotographs(): void;
        askForProject(): void;
        askForCameraFiles(): void;
        askForCamera(): void;
        askForFrames(video: number, part: number, numParts: number): void;
        save(name: string, bytes: Uint8Array): void;
        say(words: string): void;
        explain(figure: string, page: string, title: string): void;
        address(link: string): void;
        keep(project: Uint8Array): void;
        forget(): void;
        askForKept(): void;
      },
    ): Promise<void>;
    progress(work: number, share: number, words: string): void;
    soFar(work: number, answer: Uint8Array): void;
    done(work: number, answer: Uint8Array): void;
    failed(work: number, sentence: string, broken: boolean): void;
    photograph(name: string, bytes: Uint8Array): void;
    deliver(): void;
    video(video: number): void;
    frame(bytes: Uint8Array): void;
    frames(video: number, name: string): void;
    noFrames(video: number, sentence: string): void;
    notice(sentence: string): void;
    link(parameters: string[]): void;
    solved(computed: Uint8Array): void;
    project(archive: Uint8Array): void;
    cameraFile(name: string, bytes: Uint8Array): void;
    cameras(): void;
    keptProject(archive: Uint8Array): void;
    keptAside(sentence: string): void;
    kept(numBytes: number): void;
    notKept(why: string, isThere: boolean): void;
    forgotten(): void;
    theme(theme: string): void;
    widgets(): string | undefined;
    operate(widget: string, role: string, name: string, value?: number): void;
    panic(): string | undefined;
  }
  export default function load(options: { module_or_path: URL }): Promise<unknown>;
}

/** The bindings for its workers: `vision` processes photographs, `files` reads and writes files. */
declare module "epipole-lab-vision" {
  export function compute(
    request: Uint8Array,
    listener: { progress: (share: number, words: string) => void; soFar: (answer: Uint8Array) => void },
  ): Uint8Array;
  export function take_panic(): string | undefined;
  export default function load(options: { module_or_path: URL }): Promise<unknown>;
}

declare module "epipole-lab-files" {
  export { compute, take_panic } from "epipole-lab-vision";
  export { default } from "epipole-lab-vision";
}

/**
 * Addresses of the modules and the worker script relative to the page script; set by the bundler.
 */
declare const LAB_PAGE_WASM: string;
declare const LAB_VISION_WASM: string;
declare const LAB_FILES_WASM: string;
declare const LAB_WORKER: string;
/** Address of the precomputed results of the sample; set by the bundler. */
declare const LAB_SAMPLE: string;
