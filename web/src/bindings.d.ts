/** The bindings that the book builder generates; `build.mjs` says where they are. */
declare module "#bindings" {
  export class Figure {
    constructor(name: string);
    title(): string;
    help(): string;
    apply(parameters: string): string;
    state(): string;
    update(event: string): string | undefined;
    tick(dtSeconds: number): string | undefined;
    is_running(): boolean;
    snapshot(width: number): string;
    handle_at(width: number, x: number, y: number): string | undefined;
    drag(id: string, width: number, x: number, y: number): string | undefined;
    nudge(id: string, width: number, towards: string, steps: number): string | undefined;
    move_to_end(id: string, width: number, towards: string): string | undefined;
    click(width: number, x: number, y: number): string | undefined;
    refine(): boolean;
    draw(width: number, scale: number, theme: string): string | undefined;
    draw_settled(width: number, scale: number, theme: string): string | undefined;
    pixels(): number;
    pixel_width(): number;
    pixel_height(): number;
    frame_hash(): string | undefined;
  }
  export function figures(): string;
  export function take_panic(): string | undefined;
  export default function load(options: {
    module_or_path: URL;
  }): Promise<{ memory: WebAssembly.Memory }>;
}

/** Where the WebAssembly module is, relative to the script. */
declare module "#wasm" {
  const path: string;
  export default path;
}

declare module "*.css" {
  const text: string;
  export default text;
}
