/** The bindings that wasm-bindgen generates from `crates/epipole-web`, for pages. */
declare module "epipole-web" {
  export class Figure {
    constructor(name: string);
    title(): string;
    help(): string;
    apply(parameters: string[]): string;
    state(): string;
    set_number(id: string, value: number): string | undefined;
    set_flag(id: string, value: boolean): string | undefined;
    set_text(id: string, value: string): string | undefined;
    press(id: string): string | undefined;
    remove(id: string): string | undefined;
    reset(): string | undefined;
    tick(dtSeconds: number): string | undefined;
    is_running(): boolean;
    snapshot(width: number): string;
    handle_at(width: number, x: number, y: number): string | undefined;
    drag(id: string, width: number, x: number, y: number): string | undefined;
    nudge(id: string, width: number, towards: string, steps: number): string | undefined;
    move_to_end(id: string, width: number, towards: string): string | undefined;
    click(width: number, x: number, y: number): string | undefined;
    place(id: string, x: number, y: number): string | undefined;
    click_in(panel: string, x: number, y: number): string | undefined;
    solution(challenge: string): string;
    take_photo(slot: string, width: number, height: number, rgba: Uint8Array): string | undefined;
    data(): string;
    photograph(panel: string): Uint8Array;
    file(): Uint8Array;
    take_focal(slot: string, focal: number): void;
    job_key(): string | undefined;
    job_request(): Uint8Array;
    job_done(key: string, result: Uint8Array): boolean;
    job_failed(key: string, sentence: string): boolean;
    prepare(): boolean;
    refine(): boolean;
    draw(width: number, scale: number, theme: string): string | undefined;
    draw_sharp(width: number, scale: number, theme: string): string | undefined;
    pixels(): number;
    pixel_width(): number;
    pixel_height(): number;
    frame_hash(): string | undefined;
    free(): void;
  }
  export function figures(): string;
  export function take_panic(): string | undefined;
  export default function load(options: {
    module_or_path: WebAssembly.Module;
  }): Promise<{ memory: WebAssembly.Memory }>;
}

/** The bindings for workers. */
declare module "epipole-jobs" {
  export function compute(
    name: string,
    request: Uint8Array,
    listener: { progress: (share: number) => void },
  ): Uint8Array;
  export function take_panic(): string | undefined;
  export default function load(options: { module_or_path: WebAssembly.Module }): Promise<unknown>;
}

/** Address of the page's wasm module relative to the script; set by the bundler. */
declare const EPIPOLE_WASM: string;

/** Address of the workers' wasm module, likewise. */
declare const EPIPOLE_JOBS_WASM: string;

/** Address of the worker script, likewise. */
declare const EPIPOLE_WORKER: string;

/** The style sheet `figure.css` with its imports, as one string; set by the bundler. */
declare module "epipole-look" {
  const text: string;
  export default text;
}
